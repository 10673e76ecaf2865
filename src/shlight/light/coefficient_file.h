#pragma once

#include <filesystem>
#include <string>

#include "shlight/sh/coefficients.h"

namespace shlight {

// Coefficient files: JSON {"shlight": 1, "bands": n, "convention": {…}, "coefficients": [[r, g, b], … n² of them]},
// with the convention of sh/basis.h spelt out. Readers accept that convention and no other.

// The file's text.
std::string format_coefficients(const RgbCoefficients& coefficients);

void save_coefficients(const std::filesystem::path& path, const RgbCoefficients& coefficients);

// Throws Error where a part is missing, superfluous or not a finite number, or where the convention is another.
RgbCoefficients load_coefficients(const std::filesystem::path& path);

}  // namespace shlight
