#include "shlight/core/peak_memory.h"

#include <fstream>
#include <string>
#include <string_view>

namespace shlight {

namespace {

// Linux tells it in proc(5), in kibibytes.
std::uint64_t bytes_in_status(std::string_view wanted) {
  std::ifstream status("/proc/self/status");
  for (std::string name; status >> name;) {
    std::uint64_t kibibytes = 0;
    if (name == wanted) return status >> kibibytes ? 1024 * kibibytes : 0;
    std::getline(status, name);
  }
  return 0;
}

}  // namespace

std::uint64_t peak_memory() {
  return bytes_in_status("VmHWM:");
}

std::uint64_t resident_memory() {
  return bytes_in_status("VmRSS:");
}

void reset_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << 5;
}

}  // namespace shlight
