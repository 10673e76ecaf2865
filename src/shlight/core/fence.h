#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

namespace shlight {

// A fence around code that reads files from strangers. Image and model parsers of good reputation still crash, hang or
// take all memory on some malformed files; behind the fence that costs one clear Error.

struct FenceLimits {
  double seconds = 600;                     // of wall time, after which the work is killed
  std::uint64_t memory_bytes = 8ull << 30;  // of address space on top of what the process had
};

// The limits with no more time than a file of that size can need: 5 s, and one more for each megabyte.
FenceLimits limits_for_file(FenceLimits limits, std::uintmax_t file_bytes);

// Memory that the process and a child which it forked both see. Grows in the child; read by the parent.
class FencedBytes {
 public:
  FencedBytes();
  FencedBytes(FencedBytes&& other) noexcept;
  FencedBytes& operator=(FencedBytes&&) = delete;
  ~FencedBytes();

  // Makes room for `size` bytes in all, zero where new; earlier spans are dead. Throws Error.
  std::span<std::byte> resize(std::size_t size);
  // Appends a copy of `bytes`. Throws Error.
  void append(std::span<const std::byte> bytes);
  std::span<std::byte> bytes() const { return {data_, size_}; }

 private:
  friend FencedBytes run_fenced(std::string_view, std::string_view, const FenceLimits&,
                                const std::function<void(FencedBytes&)>&);
  void map(std::size_t capacity);

  int fd_ = -1;
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

// Runs `work` in a forked child and returns the bytes it wrote. An Error thrown by the work is thrown here again with
// the same words. A crash, an exceeded limit or any other exception becomes an Error "subject: …: `accepted`", for
// instance run_fenced("a.hdr", "a Radiance picture", …). Threads that the process has do not exist in the child: the
// work must start none and wait for none. A signal to the process
// group ends the child as well.
FencedBytes run_fenced(std::string_view subject, std::string_view accepted, const FenceLimits& limits,
                       const std::function<void(FencedBytes&)>& work);

}  // namespace shlight
