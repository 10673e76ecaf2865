#include "shlight/light/coefficient_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/sh/convention_text.h"

namespace shlight {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr int kMaxBands = 256;
constexpr std::uint64_t kMaxBytes = 64 << 20;

ordered_json make_convention() {
  return {{"basis", convention::kBasis}, {"condon_shortley_phase", convention::kCondonShortleyPhase},
          {"index", convention::kIndex}, {"polynomials", convention::kPolynomials},
          {"frame", convention::kFrame}, {"quantity", "radiance, nothing folded in"},
          {"color", convention::kColor}};
}

// Three finite numbers.
std::optional<std::array<double, 3>> parse_triple(const json& entry) {
  if (!entry.is_array() || entry.size() != 3) return {};
  std::array<double, 3> triple;
  for (std::size_t c = 0; c < 3; ++c) {
    if (!entry[c].is_number() || !std::isfinite(entry[c].get<double>())) return {};
    triple[c] = entry[c].get<double>();
  }
  return triple;
}

// Of unit length, to the six digits that someone may have typed, and then exactly.
std::optional<Sun> parse_sun(const json& entry) {
  if (!entry.is_object() || !entry.contains("direction") || !entry.contains("irradiance")) return {};
  const auto d = parse_triple(entry["direction"]), e = parse_triple(entry["irradiance"]);
  if (!d || !e) return {};
  const double length = std::hypot((*d)[0], (*d)[1], (*d)[2]);
  if (std::abs(length - 1) > 1e-5) return {};
  const double scale = std::abs(length - 1) > 1e-15 ? 1 / length : 1;
  return Sun{scale * Vec3d{(*d)[0], (*d)[1], (*d)[2]}, {(*e)[0], (*e)[1], (*e)[2]}};
}

CoefficientFile parse(const std::string& name, const json& root) {
  const auto fail = [&](const std::string& wrong, const std::string& accepted) { throw Error(name, wrong, accepted); };
  if (!root.is_object() || !root.contains("shlight"))
    fail("is no coefficient file (\"shlight\" is missing)",
         "{\"shlight\": 1, \"bands\": …, \"convention\": …, \"coefficients\": …}");
  if (root["shlight"] != 1) fail("is of version " + root["shlight"].dump(), "version 1");
  for (const char* key : {"bands", "convention", "coefficients"})
    if (!root.contains(key)) fail(fmt::format("\"{}\" is missing", key), "a coefficient file as shlight writes it");

  const ordered_json expected = make_convention();
  if (!root["convention"].is_object()) fail("\"convention\" is no object", expected.dump());
  for (const auto& [key, value] : expected.items())
    if (!root["convention"].contains(key) || root["convention"][key] != json(value))
      fail(fmt::format("\"convention\" has {} {}", key,
                       root["convention"].contains(key) ? root["convention"][key].dump() : "missing"),
           fmt::format("\"{}\": {}", key, value.dump()));

  const json& bands = root["bands"];
  if (!bands.is_number_integer() || bands < 1 || bands > kMaxBands)
    fail("\"bands\" is " + bands.dump(), fmt::format("a whole number from 1 to {}", kMaxBands));
  RgbCoefficients coefficients(bands.get<int>());
  const json& entries = root["coefficients"];
  if (!entries.is_array() || entries.size() != coefficients.size())
    fail(fmt::format("\"coefficients\" has {} entries", entries.is_array() ? entries.size() : 0),
         fmt::format("{} entries for {} bands", coefficients.size(), coefficients.bands()));
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto triple = parse_triple(entries[i]);
    if (!triple)
      fail(fmt::format("coefficient {} is {}", i, entries[i].dump().substr(0, 80)), "three finite numbers, [r, g, b]");
    coefficients[i] = {(*triple)[0], (*triple)[1], (*triple)[2]};
  }
  if (!root.contains("sun")) return {std::move(coefficients), {}};
  const auto sun = parse_sun(root["sun"]);
  if (!sun)
    fail("\"sun\" is " + root["sun"].dump().substr(0, 80),
         "{\"direction\": [x, y, z] of length 1, \"irradiance\": [r, g, b]}");
  return {std::move(coefficients), sun};
}

}  // namespace

std::string format_coefficients(const RgbCoefficients& coefficients, const std::optional<Sun>& sun) {
  ordered_json root = {{"shlight", 1}, {"bands", coefficients.bands()}, {"convention", make_convention()}};
  if (sun) {
    const auto& [d, e] = *sun;
    root["sun"] = {{"direction", {d.x, d.y, d.z}}, {"irradiance", {e.r, e.g, e.b}}};
  }
  // One coefficient a line, which neither of the library's two layouts gives.
  std::string text = root.dump(2);
  text.resize(text.size() - 2);
  text += ",\n  \"coefficients\": [";
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const Rgb c = coefficients[i];
    text += (i ? ",\n    " : "\n    ") + json({c.r, c.g, c.b}).dump();
  }
  return text + "\n  ]\n}\n";
}

void save_coefficients(const std::filesystem::path& path, const RgbCoefficients& coefficients,
                       const std::optional<Sun>& sun) {
  write_file(path, format_coefficients(coefficients, sun));
}

CoefficientFile load_coefficient_file(const std::filesystem::path& path) {
  const auto bytes = read_file(path, kMaxBytes);
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  json root;
  try {
    root = json::parse(text, text + bytes.size());
  } catch (const json::exception& error) {
    throw Error(path.string(), fmt::format("is no JSON ({})", error.what()), "a coefficient file as shlight writes it");
  }
  return parse(path.string(), root);
}

RgbCoefficients load_coefficients(const std::filesystem::path& path) {
  CoefficientFile file = load_coefficient_file(path);
  if (file.sun) add_sun(*file.sun, file.coefficients);
  return std::move(file.coefficients);
}

}  // namespace shlight
