#include "virtual_display.h"

#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>

namespace shlight {
namespace {

constexpr int kSecondsToStart = 30;

// The number that the server writes once it takes connections.
std::string read_number(int pipe) {
  std::string text;
  char c = 0;
  pollfd waiting = {pipe, POLLIN, 0};
  while (::poll(&waiting, 1, 1000 * kSecondsToStart) == 1 && ::read(pipe, &c, 1) == 1 && c != '\n') text += c;
  return text;
}

}  // namespace

VirtualDisplay::VirtualDisplay(int width, int height) {
  if (const char* display = ::getenv("DISPLAY")) before_ = display;
  std::array<int, 2> ends;
  if (::pipe(ends.data()) != 0) {
    problem_ = "no pipe";
    return;
  }
  const std::string screen = std::to_string(width) + "x" + std::to_string(height) + "x24";
  const std::string number_to = std::to_string(ends[1]);
  pid_ = ::fork();
  if (pid_ == 0) {
    ::close(ends[0]);
    if (!std::freopen("/dev/null", "w", stderr)) ::_exit(127);
    ::execlp("Xvfb", "Xvfb", "-displayfd", number_to.c_str(), "-screen", "0", screen.c_str(), "+extension", "GLX",
             "-nolisten", "tcp", static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ::close(ends[1]);
  const std::string number = read_number(ends[0]);
  ::close(ends[0]);
  if (number.empty())
    problem_ = "Xvfb does not start";
  else
    ::setenv("DISPLAY", (":" + number).c_str(), 1);
}

VirtualDisplay::~VirtualDisplay() {
  if (pid_ <= 0) return;
  ::kill(pid_, SIGTERM);
  ::waitpid(pid_, nullptr, 0);
  if (before_)
    ::setenv("DISPLAY", before_->c_str(), 1);
  else
    ::unsetenv("DISPLAY");
}

}  // namespace shlight
