#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace shlight {

// Values as the machine has them, one after the other, a list as its length and its items: for bytes that the same
// program reads again. Writer and reader have the same verbs, so that one template describes a layout for both.

// Where a ByteWriter may write to; FencedBytes is another.
struct ByteBuffer {
  std::vector<std::byte> bytes;
  void append(std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); }
};

// To a `Sink` that has append(std::span<const std::byte>) and outlives it.
template <class Sink>
class ByteWriter {
 public:
  static constexpr bool kIsReader = false;
  explicit ByteWriter(Sink& sink) : sink_(sink) {}

  template <class T>
  requires std::is_arithmetic_v<T>
  void field(const T& value) { sink_.append(std::as_bytes(std::span(&value, 1))); }
  // Of items without pointers: all at once.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void list(const std::vector<T>& items) {
    field(std::uint64_t{items.size()});
    sink_.append(std::as_bytes(std::span(items)));
  }
  void text(const std::string& text) {
    field(std::uint64_t{text.size()});
    sink_.append(std::as_bytes(std::span(text)));
  }
  template <class T, class EachItem>
  void list(const std::vector<T>& items, EachItem&& each) {
    field(std::uint64_t{items.size()});
    for (const T& item : items) each(item);
  }

 private:
  Sink& sink_;
};

// Throws Malformed where the bytes end too early; what it has read by then is of no use.
class ByteReader {
 public:
  struct Malformed {};
  static constexpr bool kIsReader = true;
  explicit ByteReader(std::span<const std::byte> bytes) : left_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T>
  void field(T& value) { std::memcpy(&value, take(sizeof(T)).data(), sizeof(T)); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void list(std::vector<T>& items) {
    items.resize(count(sizeof(T)));
    const auto bytes = take(items.size() * sizeof(T));
    if (!bytes.empty()) std::memcpy(items.data(), bytes.data(), bytes.size());
  }
  void text(std::string& text) {
    const auto bytes = take(count(1));
    text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  template <class T, class EachItem>
  void list(std::vector<T>& items, EachItem&& each) {
    // One by one, so that a false length ends with the bytes and not with the memory.
    const std::size_t size = count(1);
    for (std::size_t i = 0; i < size; ++i) each(items.emplace_back());
  }
  bool at_end() const { return left_.empty(); }

 private:
  // A length of items of `item_bytes` bytes at least, all of which must be there.
  std::size_t count(std::size_t item_bytes) {
    std::uint64_t count = 0;
    field(count);
    if (count > left_.size() / item_bytes) throw Malformed{};
    return count;
  }
  std::span<const std::byte> take(std::size_t size) {
    if (size > left_.size()) throw Malformed{};
    const auto taken = left_.first(size);
    left_ = left_.subspan(size);
    return taken;
  }

  std::span<const std::byte> left_;
};

}  // namespace shlight
