#include "shlight/core/peak_memory.h"

#include <fstream>
#include <string>

namespace shlight {

// Linux tells it in proc(5), in kibibytes.
std::uint64_t peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string name; status >> name;) {
    std::uint64_t kibibytes = 0;
    if (name == "VmHWM:") return status >> kibibytes ? 1024 * kibibytes : 0;
    std::getline(status, name);
  }
  return 0;
}

void reset_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << 5;
}

}  // namespace shlight
