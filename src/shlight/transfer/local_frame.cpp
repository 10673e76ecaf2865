#include "shlight/transfer/local_frame.h"

#include <array>
#include <cmath>

#include "shlight/core/assert.h"
#include "shlight/transfer/transfer.h"

namespace shlight {
namespace {

constexpr Rotation kFromYToZ = {{Vec3d{1, 0, 0}, Vec3d{0, 0, -1}, Vec3d{0, 1, 0}}};

// Each pair (m, −m) turns by m times the angle.
void turn_about_z(int bands, double c, double s, std::span<double> coefficients) {
  double cm = 1, sm = 0;
  for (int m = 1; m < bands; ++m) {
    const double next = cm * c - sm * s;
    sm = sm * c + cm * s;
    cm = next;
    for (int l = m; l < bands; ++l) {
      double& cosine = coefficients[static_cast<std::size_t>(coefficient_index(l, m))];
      double& sine = coefficients[static_cast<std::size_t>(coefficient_index(l, -m))];
      const double turned = cm * cosine - sm * sine;
      sine = sm * cosine + cm * sine;
      cosine = turned;
    }
  }
}

template <bool Inverse>
void turn_quarter(const RotationMatrix& matrix, std::span<double> coefficients) {
  std::array<double, 2 * kMaxTransferBands - 1> turned;
  for (int l = 1; l < matrix.bands(); ++l) {
    const std::size_t rows = static_cast<std::size_t>(2 * l + 1);
    const std::span<const double> block = matrix.block(l);
    double* values = coefficients.data() + l * l;
    for (std::size_t i = 0; i < rows; ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < rows; ++k) sum += (Inverse ? block[k * rows + i] : block[i * rows + k]) * values[k];
      turned[i] = sum;
    }
    for (std::size_t i = 0; i < rows; ++i) values[i] = turned[i];
  }
}

}  // namespace

LocalFrame make_local_frame(Vec3d n, double spin) {
  LocalFrame f;
  f.cos_theta = n.z;
  f.sin_theta = std::hypot(n.x, n.y);
  if (f.sin_theta > 0) f.cos_phi = n.x / f.sin_theta, f.sin_phi = n.y / f.sin_theta;
  f.cos_spin = std::cos(spin), f.sin_spin = std::sin(spin);
  const Vec3d x = {f.cos_theta * f.cos_phi, f.cos_theta * f.sin_phi, -f.sin_theta}, y = {-f.sin_phi, f.cos_phi, 0};
  f.x = f.cos_spin * x + f.sin_spin * y;
  f.y = f.cos_spin * y - f.sin_spin * x;
  f.z = n;
  return f;
}

FrameRotation::FrameRotation(int bands) : quarter_turn_(bands, kFromYToZ) {
  SHLIGHT_ASSERT_LE(bands, kMaxTransferBands);
}

void FrameRotation::to_world(const LocalFrame& f, std::span<double> coefficients) const {
  const int bands = quarter_turn_.bands();
  turn_about_z(bands, f.cos_spin, f.sin_spin, coefficients);
  turn_quarter<false>(quarter_turn_, coefficients);
  turn_about_z(bands, f.cos_theta, f.sin_theta, coefficients);
  turn_quarter<true>(quarter_turn_, coefficients);
  turn_about_z(bands, f.cos_phi, f.sin_phi, coefficients);
}

}  // namespace shlight
