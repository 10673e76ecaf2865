#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "shlight/light/sun.h"
#include "shlight/sh/coefficients.h"

namespace shlight {

// Coefficient files: JSON {"shlight": 1, "bands": n, "convention": {…}, "coefficients": [[r, g, b], … n² of them]},
// with the convention of sh/basis.h spelt out. Readers accept that convention and no other. A light whose sun was split
// off has a key more, "sun": {"direction": [x, y, z], "irradiance": [r, g, b]} (sun.h); the coefficients are then those
// of the rest, and the file's light is both.
struct CoefficientFile {
  RgbCoefficients coefficients;
  std::optional<Sun> sun;
};

// The file's text.
std::string format_coefficients(const RgbCoefficients& coefficients, const std::optional<Sun>& sun = {});

void save_coefficients(const std::filesystem::path& path, const RgbCoefficients& coefficients,
                       const std::optional<Sun>& sun = {});

// Throws Error where a part is missing, superfluous or not a finite number, or where the convention is another.
CoefficientFile load_coefficient_file(const std::filesystem::path& path);

// The coefficients of all of the file's light: its sun, if it has one, is put back.
RgbCoefficients load_coefficients(const std::filesystem::path& path);

}  // namespace shlight
