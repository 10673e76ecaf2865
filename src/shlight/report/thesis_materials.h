#pragma once

#include <span>

namespace shlight {

// The four reflection models of the thesis's figures 31 to 38 and table 3, as make_brdf takes them. It does not print
// their parameters but for Cook and Torrance's m. Not installed.
struct ThesisMaterial {
  const char *id, *name, *text;
  double thesis_seconds;  // table 3
};
std::span<const ThesisMaterial> thesis_materials();

}  // namespace shlight
