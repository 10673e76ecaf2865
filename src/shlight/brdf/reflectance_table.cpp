#include "shlight/brdf/reflectance_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "shlight/brdf/project_brdf.h"
#include "shlight/core/assert.h"
#include "shlight/core/parallel.h"
#include "shlight/sh/rotation.h"

namespace shlight {
namespace {

using std::numbers::pi;

// The polar angle of the last view, in place of 90°.
constexpr double kLastPolarAngle = 89.9 * pi / 180;

// The view at a position, in the azimuth of (x, y), which are not both zero.
Vec3d view_at(double position, double x, double y) {
  const double cosine = std::max(cosine_of_position(position), std::cos(kLastPolarAngle));
  const double scale = std::sqrt((1 - cosine) * (1 + cosine)) / std::sqrt(x * x + y * y);
  return {scale * x, scale * y, cosine};
}

float* entry_of(ReflectanceTable& table, int column, int row) {
  const auto index = static_cast<std::size_t>(row) * table.width + column;
  return table.values.data() + index * table.coefficients() * table.channels;
}

void write_value(const ReflectanceTable& table, Rgb value, float* at) {
  at[0] = static_cast<float>(value.r);
  if (table.channels == 1) return;
  at[1] = static_cast<float>(value.g);
  at[2] = static_cast<float>(value.b);
}

Rgb read_value(const ReflectanceTable& table, const float* at) {
  return table.channels == 1 ? Rgb{at[0], at[0], at[0]} : Rgb{at[0], at[1], at[2]};
}

void write_entry(const RgbCoefficients& coefficients, ReflectanceTable& table, int column, int row) {
  float* at = entry_of(table, column, row);
  for (int l = 0; l < table.bands; ++l)
    for (int m = table.isotropic() ? 0 : -l; m <= l; ++m, at += table.channels)
      write_value(table, coefficients.at(l, m), at);
}

// x -> −x changes the sign of cos mφ for odd m and of sin mφ for even m; y -> −y that of all sin mφ.
void mirror(bool x, bool y, RgbCoefficients& coefficients) {
  for (int l = 0; l < coefficients.bands(); ++l)
    for (int m = -l; m <= l; ++m) {
      const bool sine = m < 0, odd = m % 2 != 0;
      if ((x && sine != odd) != (y && sine)) coefficients.at(l, m) = -1 * coefficients.at(l, m);
    }
}

// The two entries between which `position` lies, and the share of the second.
struct Between {
  int low;
  double share;
};
Between between(double position, int size) {
  const int low = std::clamp(static_cast<int>(position), 0, size - 2);
  return {low, std::clamp(position - low, 0.0, 1.0)};
}

}  // namespace

double view_position(double cos_theta) {
  const double x = 1 - std::sqrt(std::max(0.0, 1 - cos_theta));
  return 1 - 0.5 * (x + std::sqrt(std::max(0.0, x)));
}

double cosine_of_position(double position) {
  // x + √x = 2 (1 − u), solved for √x.
  const double root = 0.5 * (std::sqrt(9 - 8 * position) - 1), s = 1 - root * root;
  return 1 - s * s;
}

ReflectanceTable make_reflectance_table(const Brdf& brdf, const ReflectanceTableParams& params) {
  SHLIGHT_ASSERT_GE(params.bands, 1);
  SHLIGHT_ASSERT_LE(params.bands, kMaxTableBands);
  SHLIGHT_ASSERT_GE(params.polar_size, 2);
  SHLIGHT_ASSERT_GE(params.square_size, 2);
  const BrdfSymmetry symmetry = brdf.traits().symmetry;
  const bool isotropic = symmetry == BrdfSymmetry::kIsotropic;
  ReflectanceTable table;
  table.bands = params.bands;
  table.channels = brdf.traits().grey ? 1 : 3;
  table.width = isotropic ? params.polar_size : params.square_size;
  table.height = isotropic ? 1 : params.square_size;
  table.values.resize(static_cast<std::size_t>(table.width) * table.height * table.coefficients() * table.channels);

  const std::vector<int> nodes = choose_nodes(brdf, params.bands, params.tolerance);
  const int size = table.width;
  const auto project = [&](Vec3d v) { return project_brdf_fixed(brdf, v, params.bands, nodes); };
  const auto coordinate = [size](int index) { return 2.0 * index / (size - 1) - 1; };
  if (isotropic) {
    // A task is several entries, to be worth its start.
    constexpr int kEntries = 8;
    parallel_for(static_cast<std::size_t>((size + kEntries - 1) / kEntries), params.threads, [&](std::size_t task) {
      const int begin = static_cast<int>(task) * kEntries;
      for (int k = begin; k < std::min(begin + kEntries, size); ++k)
        write_entry(project(view_at(static_cast<double>(k) / (size - 1), 1, 0)), table, k, 0);
    });
  } else {
    const bool mirrored = symmetry == BrdfSymmetry::kMirrored;
    const int side = mirrored ? (size + 1) / 2 : size;
    parallel_for(static_cast<std::size_t>(side), params.threads, [&](std::size_t task) {
      const int row = static_cast<int>(task), other_row = size - 1 - row;
      for (int column = 0; column < side; ++column) {
        const double x = coordinate(column), y = coordinate(row);
        const double position = std::min(1.0, std::sqrt(x * x + y * y));
        const RgbCoefficients here = project(position > 0 ? view_at(position, x, y) : Vec3d{0, 0, 1});
        write_entry(here, table, column, row);
        if (!mirrored) continue;
        const int other_column = size - 1 - column;
        for (const auto& [flip_x, flip_y] : {std::array{true, false}, {false, true}, {true, true}}) {
          RgbCoefficients there = here;
          mirror(flip_x, flip_y, there);
          write_entry(there, table, flip_x ? other_column : column, flip_y ? other_row : row);
        }
      }
    });
  }
  return table;
}

std::vector<ColoredTable> split_colors(const ReflectanceTable& table, double tolerance) {
  SHLIGHT_ASSERT_EQ(table.channels, 3);
  constexpr std::size_t kParts = 2;
  const std::size_t entry = static_cast<std::size_t>(table.coefficients()), count = table.values.size() / 3;
  const auto color_at = [](const std::vector<float>& values, std::size_t i) {
    return Vec3d{values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  };
  // Gram and Schmidt's way: the largest colour that is left is the next one.
  std::vector<float> rest = table.values;
  std::vector<ColoredTable> parts;
  while (parts.size() < kParts) {
    Vec3d color = {1, 0, 0};
    double largest = 0;
    for (std::size_t i = 0; i < count; ++i)
      if (const Vec3d c = color_at(rest, i); dot(c, c) > largest) color = c, largest = dot(c, c);
    color = (1 / std::sqrt(dot(color, color))) * color;
    ColoredTable part = {vec_cast<float>(color), {table.bands, 1, table.width, table.height, {}}};
    part.grey.values.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3d c = color_at(rest, i);
      const double share = dot(c, color);
      part.grey.values[i] = static_cast<float>(share);
      const Vec3f left = vec_cast<float>(c - share * color);
      rest[3 * i] = left.x, rest[3 * i + 1] = left.y, rest[3 * i + 2] = left.z;
    }
    parts.push_back(std::move(part));

    bool is_all = true;
    for (std::size_t at = 0; at < rest.size() && is_all; at += 3 * entry) {
      float all = 0, left = 0;
      for (std::size_t i = at; i < at + 3 * entry; ++i)
        all = std::max(all, std::abs(table.values[i])), left = std::max(left, std::abs(rest[i]));
      is_all = left <= tolerance * all;
    }
    if (is_all) return parts;
  }
  return {};
}

RgbCoefficients eval_reflectance_table(const ReflectanceTable& table, Vec3d v) {
  const double sine = std::sqrt(v.x * v.x + v.y * v.y), position = view_position(v.z);
  const double cos_phi = sine > 0 ? v.x / sine : 1, sin_phi = sine > 0 ? v.y / sine : 0;
  RgbCoefficients result(table.bands);
  const auto add = [&](int column, int row, double share) {
    const auto index = static_cast<std::size_t>(row) * table.width + column;
    const float* at = table.values.data() + index * table.coefficients() * table.channels;
    for (int l = 0; l < table.bands; ++l)
      for (int m = table.isotropic() ? 0 : -l; m <= l; ++m, at += table.channels)
        result.at(l, m) += share * read_value(table, at);
  };
  if (table.isotropic()) {
    const auto [low, share] = between(position * (table.width - 1), table.width);
    add(low, 0, 1 - share);
    add(low + 1, 0, share);
    return rotate_about_z(std::atan2(sin_phi, cos_phi), result);
  }
  const auto [column, x] = between(0.5 * (1 + position * cos_phi) * (table.width - 1), table.width);
  const auto [row, y] = between(0.5 * (1 + position * sin_phi) * (table.height - 1), table.height);
  add(column, row, (1 - x) * (1 - y));
  add(column + 1, row, x * (1 - y));
  add(column, row + 1, (1 - x) * y);
  add(column + 1, row + 1, x * y);
  return result;
}

Rgb reflect_light(const ReflectanceTable& table, Vec3d v, const RgbCoefficients& light) {
  SHLIGHT_ASSERT_GE(light.bands(), table.bands);
  const RgbCoefficients reflectance = eval_reflectance_table(table, v);
  Rgb sum;
  for (std::size_t i = 0; i < reflectance.size(); ++i) {
    const Rgb f = reflectance[i], l = light[i];
    sum += Rgb{f.r * l.r, f.g * l.g, f.b * l.b};
  }
  return sum;
}

}  // namespace shlight
