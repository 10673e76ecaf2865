#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace shlight {

// An X server without a screen (Xvfb), as DISPLAY of this process and of those that it starts, for as long as it lives.
class VirtualDisplay {
 public:
  VirtualDisplay(int width, int height);
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;
  ~VirtualDisplay();

  // Empty where it runs; else why it does not.
  const std::string& problem() const { return problem_; }

 private:
  pid_t pid_ = -1;
  std::string problem_;
  std::optional<std::string> before_;  // DISPLAY, which is restored
};

}  // namespace shlight
