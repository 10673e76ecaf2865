#include "shlight/core/fence.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <utility>

#include "shlight/core/error.h"

namespace shlight {
namespace {

constexpr std::size_t kFirstCapacity = 1 << 16;

// How the child says what became of its work; anything else it may exit with is a crash.
enum ExitCode { kDone = 0, kThrewError = 61, kOutOfMemory = 62, kThrewOther = 63 };

#ifndef SHLIGHT_SANITIZED
// What the kernel counts as this process's address space, in bytes.
std::uint64_t address_space_bytes() {
  std::uint64_t pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    unsigned long value = 0;
    if (std::fscanf(file, "%lu", &value) == 1) pages = value;
    std::fclose(file);
  }
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}
#endif

void enter_fence(const FenceLimits& limits) {
  // The child dies with its parent, dumps no core and, where it crashes, writes no trace of the parser's.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGINT, SIGTERM, SIGHUP, SIGPIPE})
    ::signal(signal, SIG_DFL);
  const rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
#ifndef SHLIGHT_SANITIZED  // a sanitizer's shadow memory is terabytes of address space
  const rlim_t bytes = address_space_bytes() + limits.memory_bytes;
  const rlimit address_space = {bytes, bytes};
  ::setrlimit(RLIMIT_AS, &address_space);
#else
  (void)limits;
#endif
  // Parsers print what they think of a file; the Error says it in our words.
  const int null = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (null >= 0) ::dup2(null, STDOUT_FILENO);
#ifndef SHLIGHT_SANITIZED
  if (null >= 0) ::dup2(null, STDERR_FILENO);
#endif
}

[[noreturn]] void run_child(const FenceLimits& limits, const std::function<void(FencedBytes&)>& work,
                            FencedBytes& bytes, int done_pipe) {
  enter_fence(limits);
  int code = kDone;
  std::string message;
  try {
    work(bytes);
  } catch (const Error& error) {
    code = kThrewError;
    message = error.what();
  } catch (const std::bad_alloc&) {
    code = kOutOfMemory;
  } catch (const std::exception& error) {
    code = kThrewOther;
    message = error.what();
  } catch (...) {
    code = kThrewOther;
    message = "unknown exception";
  }
  std::size_t size = bytes.bytes().size();
  if (code != kDone) try {
      std::memcpy(bytes.resize(message.size()).data(), message.data(), message.size());
      size = message.size();
    } catch (...) {
      code = kOutOfMemory;
    }
  // The size travels through the pipe; its arrival also tells the parent that the work is over.
  const ssize_t written = ::write(done_pipe, &size, sizeof size);
  ::_exit(written == static_cast<ssize_t>(sizeof size) ? code : kThrewOther);
}

// Waits until the pipe has the child's size, is closed by its death, or the time is up. True unless the time is up.
bool wait_for_child(int pipe, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration<double>(seconds);
  for (;;) {
    const double left = std::chrono::duration<double, std::milli>(deadline - Clock::now()).count();
    pollfd entry = {pipe, POLLIN, 0};
    const int ready = ::poll(&entry, 1, static_cast<int>(std::clamp(left, 0.0, 1e9)));
    if (ready > 0) return true;
    if (ready == 0 && left <= 0) return false;
  }
}

}  // namespace

FenceLimits limits_for_file(FenceLimits limits, std::uintmax_t file_bytes) {
  limits.seconds = std::min(limits.seconds, 5 + static_cast<double>(file_bytes) * 1e-6);
  return limits;
}

FencedBytes::FencedBytes() : fd_(::memfd_create("shlight-fence", MFD_CLOEXEC)) {
  if (fd_ < 0) throw Error("fence", "cannot make shared memory", "a Linux system with memfd_create");
}

FencedBytes::FencedBytes(FencedBytes&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)),
      data_(std::exchange(other.data_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      capacity_(std::exchange(other.capacity_, 0)) {}

FencedBytes::~FencedBytes() {
  if (data_) ::munmap(data_, capacity_);
  if (fd_ >= 0) ::close(fd_);
}

void FencedBytes::map(std::size_t capacity) {
  void* data = data_ ? ::mremap(data_, capacity_, capacity, MREMAP_MAYMOVE)
                     : ::mmap(nullptr, capacity, PROT_READ | PROT_WRITE, MAP_SHARED, fd_, 0);
  if (data == MAP_FAILED) throw std::bad_alloc();
  data_ = static_cast<std::byte*>(data);
  capacity_ = capacity;
}

std::span<std::byte> FencedBytes::resize(std::size_t size) {
  if (size > capacity_) {
    const std::size_t capacity = std::max({size, 2 * capacity_, kFirstCapacity});
    if (::ftruncate(fd_, static_cast<off_t>(capacity)) != 0) throw std::bad_alloc();
    map(capacity);
  }
  size_ = size;
  return bytes();
}

void FencedBytes::append(std::span<const std::byte> bytes) {
  const std::size_t old_size = size_;
  resize(old_size + bytes.size());
  if (!bytes.empty()) std::memcpy(data_ + old_size, bytes.data(), bytes.size());
}

FencedBytes run_fenced(std::string_view subject, std::string_view accepted, const FenceLimits& limits,
                       const std::function<void(FencedBytes&)>& work) {
  FencedBytes bytes;
  int pipe[2];
  if (::pipe2(pipe, O_CLOEXEC) != 0) throw Error(subject, "cannot be read now (no pipe left)", accepted);
  const pid_t child = ::fork();
  if (child == 0) run_child(limits, work, bytes, pipe[1]);
  ::close(pipe[1]);
  if (child < 0) {
    ::close(pipe[0]);
    throw Error(subject, fmt::format("cannot be read now ({})", std::strerror(errno)), accepted);
  }

  const bool in_time = wait_for_child(pipe[0], limits.seconds);
  std::size_t size = 0;
  bool has_size = false;
  if (in_time)
    has_size = ::read(pipe[0], &size, sizeof size) == static_cast<ssize_t>(sizeof size);
  else
    ::kill(child, SIGKILL);
  ::close(pipe[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }

  if (!in_time) throw Error(subject, fmt::format("was not read within {:.3g} s", limits.seconds), accepted);
  if (!WIFEXITED(status))
    throw Error(subject, fmt::format("is malformed (its reader crashed: {})", strsignal(WTERMSIG(status))), accepted);
  const int code = WEXITSTATUS(status);
  if (code == kOutOfMemory)
    throw Error(subject, "needs more memory than its reader may take",
                fmt::format("{} of at most {} MiB", accepted, limits.memory_bytes >> 20));
  if (!has_size || (code != kDone && code != kThrewError && code != kThrewOther))
    throw Error(subject, "is malformed (its reader gave up)", accepted);

  // The child never hands over more than it made room for, but the parent does not rely on that.
  const off_t end = ::lseek(bytes.fd_, 0, SEEK_END);
  if (end < 0 || size > static_cast<std::size_t>(end)) throw Error(subject, "is malformed (its reader lied)", accepted);
  if (size > 0) {
    if (bytes.data_) ::munmap(std::exchange(bytes.data_, nullptr), bytes.capacity_);
    bytes.map(static_cast<std::size_t>(end));
  }
  bytes.size_ = size;
  if (code == kDone) return bytes;
  const std::string message(reinterpret_cast<const char*>(bytes.data_), size);
  if (code == kThrewError) throw Error(message);
  throw Error(subject, fmt::format("is malformed ({})", message), accepted);
}

}  // namespace shlight
