#include "insight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shlight/brdf/lambert.h"
#include "shlight/brdf/make_brdf.h"
#include "shlight/core/error.h"
#include "shlight/image/tone_map.h"
#include "shlight/light/builtin_light.h"
#include "shlight/light/window_name.h"
#include "shlight/render/background.h"
#include "shlight/scene/balloon.h"

namespace shlight::viewer {
namespace {

constexpr int kMapWidth = 384;

// Where luminance is negative, the colour that balloons have there.
void mark_negative(const Image& radiance, Image8& picture) {
  constexpr std::array<std::uint8_t, 3> kMagenta = {200, 32, 150};
  for (int y = 0; y < radiance.height; ++y)
    for (int x = 0; x < radiance.width; ++x)
      if (luminance(radiance.rgb(x, y)) < 0)
        std::ranges::copy(kMagenta, &picture.values[4 * static_cast<std::size_t>(y * picture.width + x)]);
}

}  // namespace

void Insight::draw_on(GlThread& thread) {
  thread_ = &thread;
  balloon_painter_ = thread.own(std::make_unique<BalloonPainter>(thread));
}

void Insight::request_errors(const Subject& subject, const Look& look) {
  if (!subject.light->final) return;
  const bool diffuse = look.material.empty() || look.method == Method::kIrradiance || look.method == Method::kTransfer;
  const std::string material = diffuse ? "lambert:rho=1" : look.material;
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
}

void Insight::request_maps(const Subject& subject, const Look& look) {
  map_task_.request(
      fmt::format("{} {} {}", subject.light->key, look.window, look.bands),
      [light = subject.light, look](const auto& publish, const Progress&) {
        auto maps = std::make_shared<Maps>();
        const RgbCoefficients shaped = shaped_light(*light, look.window, look.bands);
        const CoefficientLight few(shaped);
        const Image reconstructed = few.lat_long(kMapWidth, worker_threads());
        // A light that is coefficients itself is all of them.
        const Image original = light->drawn.background.num_pixels() > 0
                                   ? reduce_to_size(light->drawn.background, kMapWidth)
                                   : CoefficientLight(light->drawn.coefficients).lat_long(kMapWidth, worker_threads());
        const double exposure = auto_exposure(light->drawn.coefficients);
        maps->original = make_picture8(original, exposure);
        maps->reconstructed = make_picture8(reconstructed, exposure);
        mark_negative(reconstructed, maps->reconstructed);
        maps->balloon = std::make_shared<const Scene>(make_balloon(shaped));
        publish(maps);
      },
      false);
}

// One at a time.
void Insight::request_balloon(const Settings& settings, int width, int height) {
  const Camera& camera = settings.camera;
  std::string key = fmt::format("{} {} {} {}", camera.azimuth, camera.elevation, width, height);
  for (const Vec3d& row : settings.rotate_light.rows) key += fmt::format(" {} {} {}", row.x, row.y, row.z);
  if (!balloon_ || key == balloon_key_ || awaited_balloon_.valid()) return;
  balloon_key_ = key;
  awaited_balloon_ =
      thread_->run([painter = balloon_painter_, balloon = balloon_, rotation = settings.rotate_light, camera, width,
                    height] { return painter->paint(balloon, rotation, camera, width, height); });
}

bool Insight::take_balloon() {
  if (!awaited_balloon_.valid() || !is_ready(awaited_balloon_)) return false;
  try {
    previous_balloon_ = std::exchange(balloon_picture_, awaited_balloon_.get());
  } catch (const Error&) {  // the card is full: the model's picture, which is larger, tells
    return false;
  }
  return true;
}

bool Insight::busy() const {
  return error_task_.busy() || map_task_.busy() || (awaited_balloon_.valid() && !is_ready(awaited_balloon_));
}

void Insight::point(const Subject& subject, const Side& side, const Settings& settings, double x, double y,
                    double aspect) {
  picked_.reset();
  const ModelAsset& model = *subject.model;
  if (!side.transfer() || side.transfer()->num_vertices() != model.vertices) return;
  picked_ = pick_vertex(model.content.scene, make_view(settings.camera, model.extent, aspect), x, y);
  picked_model_ = model.key;
}

std::optional<Insight::AtPointer> Insight::at_pointer(const Subject& subject, const Side& side,
                                                      const Settings& settings) const {
  const Transfer* transfer = side.transfer();
  if (!picked_ || picked_model_ != subject.model->key || !transfer || picked_->vertex >= transfer->num_vertices())
    return {};
  AtPointer at = {*picked_, {}, {}};
  const RgbCoefficients light = rotate(settings.rotate_light, resize_bands(side.picture().light, transfer->bands));
  const auto n = static_cast<std::size_t>(num_coefficients(transfer->bands));
  const auto channels = static_cast<std::size_t>(transfer->channels);
  const auto channel = [&](std::size_t c) {
    return &transfer->coefficients[(picked_->vertex * channels + c % channels) * n];
  };
  for (std::size_t i = 0; i < n; ++i) {
    at.transfer.push_back(double{channel(channels / 2)[i]});
    at.radiance +=
        Rgb{light[i].r * double{channel(0)[i]}, light[i].g * double{channel(1)[i]}, light[i].b * double{channel(2)[i]}};
  }
  return at;
}

void Insight::request(const Subject& subject, const Settings& settings, int balloon_width, int balloon_height) {
  const Look& look = settings.look();
  request_errors(subject, look);
  request_maps(subject, look);
  if (balloon_width > 0 && balloon_height > 0) request_balloon(settings, balloon_width, balloon_height);
}

bool Insight::take_news() {
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
    balloon_ = maps.balloon;
    balloon_key_.clear();
    changed = true;
  }
  return take_balloon() || changed;
}

}  // namespace shlight::viewer
