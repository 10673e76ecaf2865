#include "command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "shlight/scene/load_scene.h"
#include "shlight/transfer/baked_file.h"

namespace shlight::viewer {
namespace {

std::string quoted(const std::string& text) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || std::string_view("_-+=.,:/@%").find(c) != std::string::npos;
  };
  if (!text.empty() && std::ranges::all_of(text, plain)) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string number(double value) {
  return fmt::format("{:.6g}", std::abs(value) < 1e-9 ? 0.0 : value);
}

std::string rotation_options(const Rotation& r) {
  constexpr double kSame = 1e-9;
  if (std::abs(r.rows[1].y - 1) < kSame) {
    const double degrees = std::atan2(r.rows[0].z, r.rows[0].x) * 180 / std::numbers::pi;
    return std::abs(degrees) < kSame ? "" : " --rotate-light " + number(degrees);
  }
  std::string matrix;
  for (const Vec3d& row : r.rows)
    for (const double v : {row.x, row.y, row.z}) matrix += fmt::format("{}{:.7g}", matrix.empty() ? "" : ",", v);
  return " --rotate " + matrix;
}

std::string show_option(const Look& look) {
  switch (look.show) {
    case Show::kDegree:
      return fmt::format(" --show degree:{}", look.degree);
    case Show::kNormals:
      return " --show normals";
    case Show::kVisibility:
      return " --show visibility";
    case Show::kLit:
      break;
  }
  return "";
}

std::string transfer_options(const Look& look) {
  std::string text = fmt::format(" --transfer {}", to_text(look.transfer));
  if (look.transfer == TransferKind::kInterreflected) text += fmt::format(" --bounces {}", look.bounces);
  return text;
}

}  // namespace

std::string render_command(const Settings& settings, const Look& look, int width, int height, int samples) {
  const bool reference = look.method == Method::kReference;
  const bool visibility = look.show == Show::kVisibility && !reference;
  const Method method = visibility ? Method::kTransfer : look.method;
  std::string text = "shlight render " + quoted(settings.model) + " --light " + quoted(settings.light);
  text += fmt::format(" --method {}", to_text(method));
  const bool baked = !is_builtin_scene(settings.model) && is_baked_file(settings.model);
  const bool is_reflectance = method == Method::kReflectance || method == Method::kHybrid;
  if ((method == Method::kTransfer && !baked) || reference) text += transfer_options(look);
  if (is_reflectance && baked && look.transfer == TransferKind::kCosine) text += " --transfer cosine";
  if (method == Method::kTransfer && !baked && look.samples > 0 && look.transfer != TransferKind::kCosine)
    text += fmt::format(" --samples {}", look.samples);
  if (reference)
    text += fmt::format(" --samples {}", std::max(samples, 1));
  else
    text += fmt::format(" --bands {}", look.bands);
  if (!look.material.empty() && (reference || is_reflectance)) text += " --material " + quoted(look.material);
  if (look.shade == Shade::kVertex && is_reflectance) text += " --shade vertex";
  if (!reference && look.window != "none") text += " --window " + quoted(look.window);
  if (!reference) text += show_option(look);
  if (!reference && look.mark_negative) text += " --mark-negative";
  text += rotation_options(settings.rotate_light);
  const Camera& camera = settings.camera;
  text += fmt::format(" --camera {},{},{}", number(camera.azimuth), number(camera.elevation), number(camera.zoom));
  if (!(camera.target == Vec3d{}))
    text +=
        fmt::format(" --look-at {},{},{}", number(camera.target.x), number(camera.target.y), number(camera.target.z));
  if (settings.exposure != 0) text += " --exposure " + number(settings.exposure);
  if (settings.curve == ToneCurve::kNone) text += " --tone-map none";
  if (!settings.background) text += " --no-background";
  return text + fmt::format(" --size {}x{} -o picture.png", width, height);
}

}  // namespace shlight::viewer
