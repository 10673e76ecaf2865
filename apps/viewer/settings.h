#pragma once

#include <array>
#include <string>

#include "shlight/image/tone_map.h"
#include "shlight/render/render.h"
#include "shlight/scene/camera.h"
#include "shlight/sh/rotation.h"
#include "shlight/transfer/transfer.h"

// Everything a person can set, and setting it by name.

namespace shlight::viewer {

enum class Method { kIrradiance, kTransfer, kReflectance, kHybrid, kReference };
const char* to_text(Method method);
inline constexpr int kNumMethods = 5;

// How one side of the window is drawn.
struct Look {
  Method method = Method::kTransfer;
  int bands = 5;
  std::string window = "none";
  std::string material;  // of reflectance, hybrid and reference; empty: the model's own
  TransferKind transfer = TransferKind::kShadowed;
  int samples = 0;  // rays a vertex; 0: as many as each needs
  int bounces = 3;
  Shade shade = Shade::kPixel;
  Show show = Show::kLit;
  int degree = 0;
  bool mark_negative = false;
  bool operator==(const Look&) const = default;
};

enum class Compare { kOne, kSplit, kDifference };

struct Settings {
  std::string model = "builtin:scene";
  std::string light = "builtin:sky";
  Camera camera;
  Rotation rotate_light;
  double exposure = 0;
  ToneCurve curve = ToneCurve::kFilmic;
  bool background = true;
  Compare compare = Compare::kOne;
  double divider = 0.5;  // of the picture's width
  int side = 0;          // that the controls are about
  std::array<Look, 2> looks;
  // Which parts of the window are shown.
  bool controls = true, insight = false, timing = false, keys = false;

  Settings();
  Look& look() { return looks[static_cast<std::size_t>(side)]; }
  const Look& look() const { return looks[static_cast<std::size_t>(side)]; }
  // Whether a side is seen.
  bool shows(int which) const { return compare == Compare::kOne ? which == side : true; }
};

// Sets what `name` stands for, for instance "bands" to "5"; of the side that the controls are about, where it is one's.
// Throws Error, which lists what there is.
void set_by_name(Settings& settings, const std::string& name, const std::string& value);

}  // namespace shlight::viewer
