#include "shlight/report/machine.h"

#include <fmt/format.h>

#include <fstream>
#include <thread>

namespace shlight {

std::string describe_processor() {
  // Linux tells it here, on x86; elsewhere only the number of threads is known.
  std::ifstream cpuinfo("/proc/cpuinfo");
  std::string name = "an unnamed processor";
  for (std::string line; std::getline(cpuinfo, line);)
    if (line.starts_with("model name")) {
      const auto colon = line.find(": ");
      if (colon != std::string::npos) name = line.substr(colon + 2);
      break;
    }
  return fmt::format("{}, {} threads", name, std::thread::hardware_concurrency());
}

}  // namespace shlight
