#include "shlight/image/pixel_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace shlight {
namespace {

// True where every value is finite and none negative: nearly every picture, and quick to see. Finite values differ from
// themselves by zero, others by NaN.
bool all_clean(const Image& image, float& min, float& max) {
  float low = std::numeric_limits<float>::infinity(), high = -low, not_finite = 0;
  for (const float value : image.values) {
    not_finite += value - value;
    low = value < low ? value : low;
    high = value > high ? value : high;
  }
  min = low, max = high;
  return not_finite == 0 && low >= 0;
}

}  // namespace

PixelReport report_pixels(const Image& image) {
  PixelReport report;
  if (image.values.empty() || all_clean(image, report.min, report.max)) return report;
  report.min = std::numeric_limits<float>::infinity(), report.max = -report.min;
  const auto count = [](std::uint64_t& counter, std::optional<PixelReport::Location>& first, int x, int y) {
    if (counter++ == 0) first = {x, y};
  };
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      bool nan = false, inf = false, negative = false;
      for (const float value : image.pixel(x, y)) {
        nan |= std::isnan(value);
        inf |= std::isinf(value);
        negative |= value < 0;
        if (std::isfinite(value)) report.min = std::min(report.min, value), report.max = std::max(report.max, value);
      }
      if (nan) count(report.nan, report.first_nan, x, y);
      if (inf) count(report.inf, report.first_inf, x, y);
      if (negative) count(report.negative, report.first_negative, x, y);
    }
  if (report.min > report.max) report.min = report.max = 0;
  return report;
}

void repair_pixels(Image& image) {
  for (float& value : image.values)
    if (!std::isfinite(value)) value = 0;
}

std::string describe(const PixelReport& report, bool clamped) {
  std::string text;
  const auto add = [&](std::uint64_t count, const std::optional<PixelReport::Location>& first, const char* what,
                       const char* repair) {
    if (count == 0) return;
    text += fmt::format("{}{} pixel{} with {} (first at {}, {}), {}", text.empty() ? "" : "; ", count,
                        count == 1 ? "" : "s", what, first->x, first->y, repair);
  };
  add(report.nan, report.first_nan, "NaN", "taken as 0");
  add(report.inf, report.first_inf, "infinite values", "taken as 0");
  add(report.negative, report.first_negative, "negative values", clamped ? "taken as 0" : "kept");
  return text;
}

}  // namespace shlight
