#include "shlight/core/process.h"

#include <unistd.h>

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

// From proc(5): the 22nd field of stat is when the process started, in ticks since the machine did; the first of uptime
// is now, in seconds.
double process_age_ms() {
  constexpr int kStartField = 22;
  std::ifstream stat("/proc/self/stat"), uptime("/proc/uptime");
  double now = 0, start = 0;
  std::string field;
  // The second field is the program's name between brackets, in which there may be anything.
  std::getline(stat, field, ')');
  for (int i = 3; i < kStartField; ++i) stat >> field;
  if (!(stat >> start) || !(uptime >> now)) return 0;
  return 1000 * (now - start / static_cast<double>(::sysconf(_SC_CLK_TCK)));
}

}  // namespace shlight
