#include "shlight/brdf/merl.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "shlight/brdf/measured_grid.h"
#include "shlight/core/error.h"
#include "shlight/core/file.h"

namespace shlight {
namespace {

constexpr std::size_t kHeader = 3 * sizeof(std::int32_t);
constexpr std::int64_t kMostCells = 90 * 90 * 360;
constexpr const char* kAccepted = "a MERL .binary file: three sizes such as 90, 90, 180, and 3 x 90 x 90 x 180 doubles";

}  // namespace

MerlBrdf load_merl(const std::filesystem::path& file) {
  const std::vector<std::byte> bytes = read_file(file, kHeader + 3 * kMostCells * sizeof(double));
  const auto fail = [&](const std::string& wrong) { throw Error(file.string(), wrong, kAccepted); };
  if (bytes.size() < kHeader) fail(fmt::format("has {} bytes, which is no header", bytes.size()));
  std::array<std::int32_t, 3> sizes{};
  std::memcpy(sizes.data(), bytes.data(), kHeader);
  std::int64_t cells = 1;
  for (const std::int32_t size : sizes) {
    if (size < 1 || size > kMostCells || (cells *= size) > kMostCells)
      fail(fmt::format("has a grid of {} x {} x {} cells", sizes[0], sizes[1], sizes[2]));
  }
  const std::size_t count = static_cast<std::size_t>(cells), expected = kHeader + 3 * count * sizeof(double);
  if (bytes.size() != expected)
    fail(fmt::format("has {} bytes, where {} x {} x {} cells take {}", bytes.size(), sizes[0], sizes[1], sizes[2],
                     expected));

  MeasuredGrid grid{static_cast<std::size_t>(sizes[0]), static_cast<std::size_t>(sizes[1]),
                    static_cast<std::size_t>(sizes[2]), std::vector<Rgb>(count)};
  MerlBrdf result;
  result.samples = count;
  const auto sample = [&](std::size_t channel, std::size_t cell) {
    double value = 0;
    std::memcpy(&value, bytes.data() + kHeader + (channel * count + cell) * sizeof value, sizeof value);
    if (!std::isfinite(value)) fail(fmt::format("has a sample that is not finite, {} of channel {}", cell, channel));
    return value;
  };
  for (std::size_t cell = 0; cell < count; ++cell) {
    const Rgb value = {sample(0, cell) / 1500, sample(1, cell) * 1.15 / 1500, sample(2, cell) * 1.66 / 1500};
    const bool missing = value.r < 0 || value.g < 0 || value.b < 0;
    grid.values[cell] = missing ? Rgb{-1, -1, -1} : value;
    result.missing += missing;
  }
  if (result.missing == count) fail("has negative samples only");
  result.brdf = make_measured_brdf(std::move(grid));
  return result;
}

}  // namespace shlight
