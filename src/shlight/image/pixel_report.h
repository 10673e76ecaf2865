#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "shlight/image/image.h"

namespace shlight {

// What a picture holds that a light should not.
struct PixelReport {
  struct Location {
    int x = 0, y = 0;
  };
  std::uint64_t nan = 0, inf = 0, negative = 0;                  // pixels with such a channel
  std::optional<Location> first_nan, first_inf, first_negative;  // in reading sequence
  float min = 0, max = 0;                                        // of all finite values

  bool clean() const { return nan == 0 && inf == 0 && negative == 0; }
};

PixelReport report_pixels(const Image& image);

// The stated rule: values that are not finite become 0; negative ones are kept.
void repair_pixels(Image& image);

// One line for people ("2 pixels with NaN (first at 3, 5), taken as 0"); empty where the report is clean. Says that
// negative values were kept unless they were clamped.
std::string describe(const PixelReport& report, bool clamped = false);

}  // namespace shlight
