#include "shlight/core/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "shlight/core/error.h"

namespace shlight {
namespace {

// An open file descriptor, closed when it goes out of scope.
class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) : fd_(fd) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }
  // Closes now; false where the system reports only now that the data did not reach the disk.
  bool close() {
    const int fd = fd_;
    fd_ = -1;
    return ::close(fd) == 0;
  }

 private:
  int fd_;
};

Error cannot_write(const std::filesystem::path& path) {
  return Error(path.string(), fmt::format("cannot be written ({})", std::strerror(errno)),
               "a file name in an existing, writable folder with room on its disk");
}

// The status of what a file is to replace, zero where there is nothing.
struct stat status_to_replace(const std::filesystem::path& path) {
  // rename() would replace a device or a pipe by a file, and cannot replace a folder.
  struct stat status = {};
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    throw Error(path.string(), "is not a regular file", "a new file name, or a file to replace");
  return status;
}

// Makes a file of a new name beside `path`, in the same folder so that it can be renamed.
int open_temporary(const std::filesystem::path& path, std::string& temporary) {
  temporary = path.string() + ".XXXXXX";
  const int file = ::mkostemp(temporary.data(), O_CLOEXEC);
  if (file < 0) throw cannot_write(path);
  return file;
}

}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status = {};
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0)
    throw Error(path.string(), fmt::format("cannot be read ({})", std::strerror(errno)), "a readable file");
  if (!S_ISREG(status.st_mode)) throw Error(path.string(), "is not a regular file", "a readable file");
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > max_bytes)
    throw Error(path.string(), fmt::format("holds {} bytes", size), fmt::format("at most {} bytes", max_bytes));

  std::vector<std::byte> bytes(size);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::read(file.get(), bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw Error(path.string(), fmt::format("cannot be read ({})", std::strerror(errno)), "a readable file");
    if (n == 0) break;  // the file shrank since it was measured
    done += static_cast<std::size_t>(n);
  }
  bytes.resize(done);
  return bytes;
}

void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const struct stat status = status_to_replace(path);
  std::string temporary;
  FileDescriptor file(open_temporary(path, temporary));

  // Temporary files are born private; the result gets the permissions of the file it replaces, or the usual ones.
  bool good = true;
  const mode_t mask = ::umask(0);
  ::umask(mask);
  const mode_t mode = status.st_mode != 0 ? status.st_mode & 07777 : 0666 & ~mask;
  good = ::fchmod(file.get(), mode) == 0;

  std::size_t done = 0;
  while (good && done < bytes.size()) {
    const ssize_t n = ::write(file.get(), bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    good = n >= 0;
    if (good) done += static_cast<std::size_t>(n);
  }
  good = good && file.close() && ::rename(temporary.c_str(), path.c_str()) == 0;
  if (!good) {
    const int reason = errno;
    ::unlink(temporary.c_str());
    errno = reason;
    throw cannot_write(path);
  }
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  write_file(path, std::as_bytes(std::span(text)));
}

void check_writable(const std::filesystem::path& path) {
  status_to_replace(path);
  std::string temporary;
  const FileDescriptor file(open_temporary(path, temporary));
  ::unlink(temporary.c_str());
}

}  // namespace shlight
