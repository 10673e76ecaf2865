#include "insight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shlight/brdf/lambert.h"
#include "shlight/brdf/make_brdf.h"
#include "shlight/image/tone_map.h"
#include "shlight/light/builtin_light.h"
#include "shlight/light/window_name.h"
#include "shlight/render/background.h"
#include "shlight/scene/balloon.h"
#include "shlight/scene/pick.h"

namespace shlight::viewer {
namespace {

constexpr int kMapWidth = 384;

// What the balloon is lit by: soft, and bright from everywhere.
RgbCoefficients balloon_light() {
  RgbCoefficients light(2);
  light[0] = {2.6, 2.6, 2.6};
  light.at(1, -1) = {0.9, 0.9, 0.9};
  light.at(1, 0) = {0.35, 0.35, 0.35};
  return light;
}

}  // namespace

void Insight::request(const Subject& subject, const Look& look) {
  const bool diffuse = look.material.empty() || look.method == Method::kIrradiance || look.method == Method::kTransfer;
  const std::string material = diffuse ? "lambert:rho=1" : look.material;
  if (subject.light->final)
    error_task_.request(
        fmt::format("{} {} {}", subject.light->key, material, look.window),
        [light = subject.light, material, window = look.window](const auto& publish, const Progress&) {
          BandErrorParams params;
          params.threads = worker_threads();
          if (window != "none")
            params.shape = [&](const RgbCoefficients& c) { return apply_named_window(window, c).coefficients; };
          publish(std::make_shared<const std::optional<BandErrors>>(
              measure_band_errors(*light->loaded->light, *make_brdf(material), params)));
        },
        false);
  map_task_.request(
      fmt::format("{} {} {}", subject.light->key, look.window, look.bands),
      [light = subject.light, look](const auto& publish, const Progress&) {
        auto maps = std::make_shared<Maps>();
        const RgbCoefficients shaped =
            apply_named_window(look.window, resize_bands(light->drawn.coefficients, look.bands)).coefficients;
        const CoefficientLight few(shaped);
        const Image reconstructed = few.lat_long(kMapWidth, worker_threads());
        // A light that is coefficients itself is all of them.
        const Image original = light->drawn.background.num_pixels() > 0
                                   ? reduce_to_size(light->drawn.background, kMapWidth)
                                   : CoefficientLight(light->drawn.coefficients).lat_long(kMapWidth, worker_threads());
        const double exposure = auto_exposure(light->drawn.coefficients);
        maps->original = make_picture8(original, exposure);
        maps->reconstructed = make_picture8(reconstructed, exposure);
        maps->balloon = make_balloon(shaped);
        publish(maps);
      },
      false);
}

void Insight::draw_balloon(const Camera& camera, int width, int height) {
  if (!balloon_) return;
  const std::string key = fmt::format("{} {} {} {}", camera.azimuth, camera.elevation, width, height);
  if (key == balloon_key_) return;
  balloon_key_ = key;
  const RgbCoefficients light = balloon_light();
  if (!balloon_renderer_) {
    balloon_renderer_.emplace(IrradianceRenderer(light));
    RgbCoefficients grey(1);
    grey[0] = {0.085, 0.09, 0.1};
    balloon_background_.emplace(grey);
  }
  if (!balloon_frame_ || balloon_frame_->width() != width || balloon_frame_->height() != height)
    balloon_frame_.emplace(width, height);
  Camera seen;
  seen.azimuth = camera.azimuth, seen.elevation = camera.elevation, seen.zoom = 1;
  const Extent ball;  // balloons have radius 1
  balloon_frame_->draw({*balloon_, ball, *balloon_renderer_, &*balloon_background_, {}},
                       {seen, {}, 0, ToneCurve::kFilmic});
}

void Insight::point(const Subject& subject, const Side& side, const Settings& settings, double x, double y,
                    double aspect) {
  at_pointer_.reset();
  const Transfer* transfer = side.transfer();
  const ModelAsset& model = *subject.model;
  if (!transfer || transfer->num_vertices() != model.vertices) return;
  const auto picked = pick_vertex(model.content.scene, make_view(settings.camera, model.extent, aspect), x, y);
  if (!picked) return;
  AtPointer at = {picked->vertex, {}, {}};
  const RgbCoefficients light = rotate(settings.rotate_light, resize_bands(side.light(), transfer->bands));
  const auto n = static_cast<std::size_t>(num_coefficients(transfer->bands));
  const auto channels = static_cast<std::size_t>(transfer->channels);
  const auto channel = [&](std::size_t c) {
    return &transfer->coefficients[(picked->vertex * channels + c % channels) * n];
  };
  for (std::size_t i = 0; i < n; ++i) {
    at.transfer.push_back(double{channel(channels / 2)[i]});
    at.radiance +=
        Rgb{light[i].r * double{channel(0)[i]}, light[i].g * double{channel(1)[i]}, light[i].b * double{channel(2)[i]}};
  }
  at_pointer_ = std::move(at);
}

bool Insight::update(const Subject& subject, const Look& look, const Camera& camera, int width, int height) {
  request(subject, look);
  bool changed = false;
  if (const auto news = error_task_.poll(); news && news->result) {
    errors_ = **news->result;
    energy_.clear();
    if (errors_)
      for (const double energy : errors_->light_energy) energy_.push_back(energy / errors_->light_total);
    changed = true;
  }
  if (const auto news = map_task_.poll(); news && news->result) {
    const Maps& maps = **news->result;
    original_.emplace(maps.original);
    reconstructed_.emplace(maps.reconstructed);
    balloon_.emplace(maps.balloon);
    balloon_key_.clear();
    changed = true;
  }
  if (width > 0 && height > 0) draw_balloon(camera, width, height);
  return changed;
}

}  // namespace shlight::viewer
