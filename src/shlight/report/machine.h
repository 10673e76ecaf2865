#pragma once

#include <string>

namespace shlight {

// The processor's name and how many threads it runs at once, as "Intel(R) Xeon(R), 2 threads". Not installed.
std::string describe_processor();

}  // namespace shlight
