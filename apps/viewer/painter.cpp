#include "painter.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace shlight::viewer {
namespace {

// So much is drawn before the window's turn comes.
constexpr double kPartMs = 6;

std::size_t bytes_of(const std::vector<SurfaceReflectance>& surfaces) {
  std::size_t floats = 0;
  for (const SurfaceReflectance& surface : surfaces) {
    if (surface.plain) floats += surface.plain->values.size();
    if (surface.tinted) floats += surface.tinted->values.size();
  }
  return floats * sizeof(float);
}

LightScale scale_of(const PictureRequest& request) {
  return request.renderer.lit() ? light_scale(request.light->drawn.coefficients) : LightScale{};
}

}  // namespace

void Painter::build_renderer(const PictureRequest& request) {
  const RendererSpec& spec = request.renderer;
  if (spec.key == built_.key) return;
  renderer_.reset();  // two of them may be more than the card holds
  built_ = {};
  for (auto& [coarseness, canvas] : canvases_) canvas.parts = FrameInParts(canvas.frame);  // takes other times
  light_key_.clear();
  const RgbCoefficients any_light(spec.bands);  // refresh_light() gives the one to draw
  if (spec.show == Show::kNormals) {
    bytes_ = 0;
    renderer_.emplace(NormalRenderer());
  } else if (spec.transfer) {
    const Transfer& transfer = *spec.transfer->transfer;
    const ModelAsset& model = *spec.model;
    const Baked& content = model.content;
    bytes_ = transfer.coefficients.size() * sizeof(float);
    if (model.is_baked && content.info.pca)
      renderer_.emplace(TransferRenderer(*content.info.pca, RgbCoefficients(content.info.pca->bands)));
    else
      renderer_.emplace(TransferRenderer(transfer, any_light, model.is_baked ? content.info.bits : 32));
  } else if (spec.tables) {
    const Tables& tables = *spec.tables;
    bytes_ = bytes_of(tables.surfaces);
    renderer_.emplace(ReflectanceRenderer(tables.surfaces, any_light, spec.shade,
                                          tables.highlights ? &*tables.highlights : nullptr, scale_of(request).unit));
  } else {
    bytes_ = 3 * sizeof(float) * any_light.size();
    renderer_.emplace(IrradianceRenderer(any_light));
  }
  built_ = spec;
}

// Gives the renderer and the background the light as it is now.
void Painter::refresh_light(const PictureRequest& request) {
  const RendererSpec& spec = request.renderer;
  const bool one_degree = spec.show == Show::kDegree;
  const std::string key =
      fmt::format("{} {} {} {}", request.light->key, request.window, one_degree ? request.degree : -1, spec.lit());
  if (key == light_key_) return;
  scale_ = scale_of(request);
  light_ = shaped_light(*request.light, request.window, spec.bands);
  if (one_degree) light_ = keep_degree(light_, std::min(request.degree, spec.bands - 1));
  const RgbCoefficients drawn = spec.lit() ? scaled(scale_.unit, light_) : visibility_light(spec.bands);
  set_radiance(*renderer_, drawn);
  light_key_ = key;

  const bool has_picture = request.light->drawn.background.num_pixels() > 0 && spec.show == Show::kLit;
  const std::string background_key = has_picture ? request.light->key : key;
  if (background_key == background_key_ || !spec.lit()) return;
  if (has_picture)
    background_.emplace(request.light->behind);
  else
    background_.emplace(drawn);
  background_key_ = background_key;
}

Painter::Canvas& Painter::canvas_of(const PictureRequest& request) {
  if (request.width != width_ || request.height != height_) {
    drawn_ = nullptr;
    canvases_.clear();
    width_ = request.width, height_ = request.height;
  }
  return canvases_
      .try_emplace(request.coarseness, std::max(width_ / request.coarseness, 1),
                   std::max(height_ / request.coarseness, 1))
      .first->second;
}

Picture Painter::paint_traced(const PictureRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  if (!traced_picture_ || traced_picture_->width() != request.width || traced_picture_->height() != request.height) {
    traced_picture_.emplace(request.width, request.height);
    traced_.reset();
  }
  const LightScale scale = light_scale(request.light->drawn.coefficients);
  if (traced_ != request.traced) {
    traced_picture_->set(request.traced->result.radiance, scale.unit);
    traced_ = request.traced;
  }
  traced_picture_->draw(exposed(scale, request.frame), request.frame.curve);
  const auto target = targets_.free_one(request.width, request.height);
  traced_picture_->swap_picture(*target);
  gl::finish();
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  return {target, 1, took.count(), {}, traced_, light_, bytes_};
}

Image Painter::read_radiance() const {
  if (!drawn_) throw Error("picture", "could not be drawn", "a smaller one");
  return drawn_->read_radiance();
}

// How long the card took, where the driver tells. Without what is between the parts, which is the window's.
std::optional<double> Painter::draw(Canvas& canvas, GpuScene& scene, const Drawing& drawing, const FrameParams& frame,
                                    const Progress& progress) {
  if (!timer_) timer_.emplace();
  const std::size_t number = ++paintings_;
  std::optional<double> gpu_ms;
  const auto take_times = [&] {
    while (const auto time = timer_->take())
      if (time->number == number) gpu_ms = gpu_ms.value_or(0) + time->ms;
  };
  canvas.parts.begin(scene);
  gl::finish();  // what was uploaded and compiled
  thread_.give_way();
  while (canvas.parts.going_on()) {
    timer_->begin(number);
    canvas.parts.draw(scene, drawing, frame, kPartMs);
    timer_->end();
    take_times();
    if (!canvas.parts.going_on()) break;
    thread_.give_way();
    report_progress(progress, 0);
  }
  gl::finish();
  take_times();
  return gpu_ms;
}

Picture Painter::paint(const PictureRequest& request, const Progress& progress) {
  report_progress(progress, 0);
  if (request.traced) return paint_traced(request);
  build_renderer(request);
  refresh_light(request);
  Canvas& canvas = canvas_of(request);
  FrameParams frame = request.frame;
  if (!request.renderer.lit()) frame.exposure = 0, frame.curve = ToneCurve::kNone;
  const float bright = request.mark_negative ? static_cast<float>(1 / exposed(scale_, frame)) : 0;
  mark_negative(*renderer_, {bright, 0, bright});
  if (request.shadows != shadows_) {
    gpu_shadows_.reset();
    if (request.shadows) gpu_shadows_.emplace(request.shadows->of_vertices);
    shadows_ = request.shadows;
  }
  GpuScene& scene =
      request.gpu->get(needs_tangents(*renderer_), request.renderer.show != Show::kVisibility, request.coarseness > 1);
  scene.set_shadows(gpu_shadows_ ? &*gpu_shadows_ : nullptr);  // the other side draws the same scene with its own
  const Background* background = request.background && request.renderer.lit() ? &*background_ : nullptr;
  const Drawing drawing = {scene, request.gpu->asset().extent, *renderer_, background, scale_};

  drawn_ = nullptr;
  const std::optional<double> gpu_ms = draw(canvas, scene, drawing, frame, progress);
  drawn_ = &canvas.frame;
  const auto target = targets_.free_one(canvas.frame.width(), canvas.frame.height());
  canvas.frame.swap_picture(*target);
  return {target, request.coarseness, canvas.parts.spent_ms(), gpu_ms, {}, light_, bytes_};
}

}  // namespace shlight::viewer
