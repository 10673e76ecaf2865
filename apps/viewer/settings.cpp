#include "settings.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <vector>

#include "shlight/brdf/make_brdf.h"
#include "shlight/core/error.h"
#include "shlight/light/window_name.h"
#include "shlight/transfer/baked_file.h"
#include "shlight/truth/path_tracer.h"

namespace shlight::viewer {
namespace {

constexpr std::array<const char*, kNumMethods> kMethods = {"irradiance", "transfer", "reflectance", "hybrid",
                                                           "reference"};

[[noreturn]] void refuse(const std::string& value, const std::string& accepted) {
  throw Error("'" + value + "'", "cannot be set", accepted);
}

double to_number(const std::string& text, double low, double high) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= low) || !(value <= high))
    refuse(text, fmt::format("a number from {} to {}", low, high));
  return value;
}

int to_int(const std::string& text, int low, int high) {
  const double value = to_number(text, low, high);
  if (value != std::floor(value)) refuse(text, fmt::format("a whole number from {} to {}", low, high));
  return static_cast<int>(value);
}

std::vector<double> to_numbers(const std::string& text, std::size_t least, std::size_t most) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    numbers.push_back(to_number(text.substr(at, comma - at), -36000, 36000));
    at = comma + 1;
  }
  if (numbers.size() < least || numbers.size() > most)
    refuse(text, fmt::format("{} to {} numbers between commas", least, most));
  return numbers;
}

template <class Value>
Value to_choice(const std::string& text, const std::map<std::string, Value>& choices) {
  if (const auto found = choices.find(text); found != choices.end()) return found->second;
  std::string accepted;
  for (const auto& [name, value] : choices) accepted += (accepted.empty() ? "" : ", ") + name;
  refuse(text, accepted);
}

bool to_switch(const std::string& text) {
  return to_choice<bool>(text, {{"on", true}, {"off", false}});
}

void set_camera(Settings& settings, const std::string& text) {
  const std::vector<double> n = to_numbers(text, 2, 3);
  if (std::abs(n[1]) > 90 || (n.size() > 2 && (n[2] < 0.01 || n[2] > 100)))
    refuse(text, "azimuth, elevation (-90 to 90) in degrees, zoom (0.01 to 100)");
  settings.camera.azimuth = n[0];
  settings.camera.elevation = n[1];
  if (n.size() > 2) settings.camera.zoom = n[2];
}

void set_show(Look& look, const std::string& text) {
  if (text.starts_with("degree:")) {
    look.degree = to_int(text.substr(7), 0, kMaxRenderBands - 1);
    look.show = Show::kDegree;
    look.bands = std::max(look.bands, look.degree + 1);
  } else {
    look.show =
        to_choice<Show>(text, {{"light", Show::kLit}, {"normals", Show::kNormals}, {"visibility", Show::kVisibility}});
  }
}

using Setter = std::function<void(Settings&, const std::string&)>;

const std::map<std::string, Setter>& setters() {
  static const std::map<std::string, Setter> all = {
      {"model", [](Settings& s, const std::string& v) { s.model = v; }},
      {"light", [](Settings& s, const std::string& v) { s.light = v; }},
      {"camera", set_camera},
      {"look-at",
       [](Settings& s, const std::string& v) {
         const auto n = to_numbers(v, 3, 3);
         s.camera.target = {n[0], n[1], n[2]};
       }},
      {"rotate-light",
       [](Settings& s, const std::string& v) {
         s.rotate_light = rotation_about_y(to_number(v, -36000, 36000) * std::numbers::pi / 180);
       }},
      {"exposure", [](Settings& s, const std::string& v) { s.exposure = to_number(v, -60, 60); }},
      {"tone-map",
       [](Settings& s, const std::string& v) {
         s.curve = to_choice<ToneCurve>(v, {{"filmic", ToneCurve::kFilmic}, {"none", ToneCurve::kNone}});
       }},
      {"background", [](Settings& s, const std::string& v) { s.background = to_switch(v); }},
      {"compare",
       [](Settings& s, const std::string& v) {
         s.compare = to_choice<Compare>(
             v, {{"one", Compare::kOne}, {"split", Compare::kSplit}, {"difference", Compare::kDifference}});
       }},
      {"divider", [](Settings& s, const std::string& v) { s.divider = to_number(v, 0, 1); }},
      {"side",
       [](Settings& s, const std::string& v) {
         s.side = to_choice<int>(v, {{"a", 0}, {"b", 1}});
       }},
      {"controls", [](Settings& s, const std::string& v) { s.controls = to_switch(v); }},
      {"insight", [](Settings& s, const std::string& v) { s.insight = to_switch(v); }},
      {"timing", [](Settings& s, const std::string& v) { s.timing = to_switch(v); }},
      {"keys", [](Settings& s, const std::string& v) { s.keys = to_switch(v); }},
      {"method",
       [](Settings& s, const std::string& v) {
         std::map<std::string, Method> methods;
         for (std::size_t i = 0; i < kMethods.size(); ++i) methods.emplace(kMethods[i], static_cast<Method>(i));
         s.look().method = to_choice(v, methods);
       }},
      {"bands", [](Settings& s, const std::string& v) { s.look().bands = to_int(v, 1, kMaxRenderBands); }},
      {"window",
       [](Settings& s, const std::string& v) {
         if (!is_window_name(v)) refuse(v, kWindowNames);
         s.look().window = v;
       }},
      {"material",
       [](Settings& s, const std::string& v) {
         if (v != "own") make_brdf(v);  // throws where there is none
         s.look().material = v == "own" ? "" : v;
       }},
      {"transfer",
       [](Settings& s, const std::string& v) {
         const auto kind = find_transfer_kind(v);
         if (!kind) refuse(v, "cosine, shadowed, interreflected");
         s.look().transfer = *kind;
       }},
      {"samples", [](Settings& s,
                     const std::string& v) { s.look().samples = v == "auto" ? 0 : to_int(v, 1, kMaxTransferSamples); }},
      {"bounces", [](Settings& s, const std::string& v) { s.look().bounces = to_int(v, 0, 64); }},
      {"shade",
       [](Settings& s, const std::string& v) {
         s.look().shade = to_choice<Shade>(v, {{"pixel", Shade::kPixel}, {"vertex", Shade::kVertex}});
       }},
      {"show", [](Settings& s, const std::string& v) { set_show(s.look(), v); }},
      {"mark-negative", [](Settings& s, const std::string& v) { s.look().mark_negative = to_switch(v); }},
  };
  return all;
}

}  // namespace

const char* to_text(Method method) {
  return kMethods[static_cast<std::size_t>(method)];
}

Settings::Settings() {
  camera.azimuth = 30, camera.elevation = 11, camera.zoom = 1;
  looks[0].window = "auto-radiance";  // shadows that ring are not what one would want to see first
  exposure = 0.4;
  looks[1].method = Method::kReference;
}

void set_by_name(Settings& settings, const std::string& name, const std::string& value) {
  const auto found = setters().find(name);
  if (found == setters().end()) {
    std::string names;
    for (const auto& [key, setter] : setters()) names += (names.empty() ? "" : ", ") + key;
    throw Error("'" + name + "'", "is nothing that can be set", names);
  }
  found->second(settings, value);
}

}  // namespace shlight::viewer
