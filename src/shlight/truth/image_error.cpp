#include "shlight/truth/image_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "shlight/core/assert.h"
#include "shlight/core/error.h"
#include "shlight/core/parallel.h"
#include "shlight/image/pixel_report.h"
#include "shlight/image/tone_map.h"
#include "shlight/truth/ssim.h"

namespace shlight {
namespace {

Rgb encode(Rgb linear) {
  const auto f = [](double v) { return encode_srgb(std::clamp(v, 0.0, 1.0)); };
  return {f(linear.r), f(linear.g), f(linear.b)};
}

// Calls f(x, y) for each pixel, rows in parallel.
template <class F>
void for_pixels(const Image& image, int threads, const F& f) {
  parallel_for(static_cast<std::size_t>(image.height), threads, [&](std::size_t row) {
    for (int x = 0; x < image.width; ++x) f(x, static_cast<int>(row));
  });
}

Image encoded(const Image& image, int threads) {
  Image result(image.width, image.height);
  for_pixels(image, threads, [&](int x, int y) { result.set_rgb(x, y, encode(image.rgb(x, y))); });
  return result;
}

// Luma of pictures that are shown, in [0, 1].
Plane luma(const Image& image) {
  Plane plane(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) plane.at(x, y) = static_cast<float>(luminance(image.rgb(x, y)));
  return plane;
}

Image shown(const Image& radiance, double exposure, int threads) {
  Image result(radiance.width, radiance.height);
  for_pixels(radiance, threads,
             [&](int x, int y) { result.set_rgb(x, y, encode(tone_map(exposure * radiance.rgb(x, y)))); });
  return result;
}

double mean_luminance(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += luminance(image.rgb(x, y));
  return sum / static_cast<double>(image.num_pixels());
}

double root_mean_square(const std::vector<float>& values) {
  const double sum =
      std::accumulate(values.begin(), values.end(), 0.0, [](double s, float v) { return s + double{v} * double{v}; });
  return std::sqrt(sum / static_cast<double>(values.size()));
}

std::vector<WorstPixel> find_worst(const Plane& difference, const Image& test, const Image& reference, int count) {
  std::vector<std::size_t> sequence(difference.values.size());
  std::iota(sequence.begin(), sequence.end(), std::size_t{0});
  std::ranges::stable_sort(sequence, std::greater<>(), [&](std::size_t i) { return difference.values[i]; });
  std::vector<WorstPixel> worst;
  for (const std::size_t i : sequence) {
    if (std::ssize(worst) == count || !(difference.values[i] > 0)) break;
    const auto width = static_cast<std::size_t>(difference.width);
    const Pixel p = {static_cast<int>(i % width), static_cast<int>(i / width)};
    const bool is_near = std::ranges::any_of(worst, [p](const WorstPixel& other) {
      return std::max(std::abs(other.pixel.x - p.x), std::abs(other.pixel.y - p.y)) < kWorstApart;
    });
    if (!is_near) worst.push_back({p, difference.values[i], test.rgb(p.x, p.y), reference.rgb(p.x, p.y)});
  }
  return worst;
}

void check_finite(const Image& image, const std::string& name) {
  const PixelReport report = report_pixels(image);
  if (report.nan == 0 && report.inf == 0) return;
  const auto first = report.nan > 0 ? report.first_nan : report.first_inf;
  throw Error(name,
              fmt::format("{} pixels with NaN and {} with infinite values, the first at {}, {}", report.nan, report.inf,
                          first->x, first->y),
              "finite pixels");
}

}  // namespace

void check_comparable(const Image& test, const std::string& test_name, const Image& reference,
                      const std::string& reference_name) {
  if (test.width != reference.width || test.height != reference.height)
    throw Error(test_name,
                fmt::format("{} x {} pixels, but {} has {} x {}", test.width, test.height, reference_name,
                            reference.width, reference.height),
                "two pictures of one size");
  check_finite(test, test_name);
  check_finite(reference, reference_name);
}

ImageError measure_error(const Image& test, const Image& reference, const ImageErrorParams& params) {
  SHLIGHT_ASSERT_EQ(test.width, reference.width);
  SHLIGHT_ASSERT_EQ(test.height, reference.height);
  const bool is_shown = params.meaning == Meaning::kShown;
  const Image a = is_shown ? encoded(test, params.threads) : test;
  const Image b = is_shown ? encoded(reference, params.threads) : reference;

  ImageError error;
  error.difference = Plane(a.width, a.height);
  Image differences = a;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    differences.values[i] = std::abs(a.values[i] - b.values[i]);
    float& largest = error.difference.values[i / 3];
    largest = std::max(largest, differences.values[i]);
  }
  error.rmse = root_mean_square(differences.values);
  error.max_error = *std::ranges::max_element(error.difference.values);
  const double size = root_mean_square(b.values);
  error.relative = error.rmse == 0 ? 0 : error.rmse / size;
  const double peak = is_shown ? 1 : *std::ranges::max_element(b.values);
  error.psnr = error.rmse == 0 ? std::numeric_limits<double>::infinity() : 20 * std::log10(peak / error.rmse);
  error.worst = find_worst(error.difference, a, b, params.num_worst);

  FlipParams flip = params.flip;
  flip.threads = params.threads;
  if (is_shown) {
    error.ssim = mean_ssim(ssim_map(luma(a), luma(b), params.threads));
    error.flip_map = flip_map(test, reference, flip);
  } else {
    const double mean_of_reference = mean_luminance(reference);
    const double exposure = mean_of_reference > 0 ? 0.18 / mean_of_reference : 1;
    error.ssim = mean_ssim(ssim_map(luma(shown(test, exposure, params.threads)),
                                    luma(shown(reference, exposure, params.threads)), params.threads));
    error.flip_map = hdr_flip_map(test, reference, flip);
  }
  error.flip = mean(error.flip_map);
  return error;
}

}  // namespace shlight
