#include "side.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "shlight/brdf/make_brdf.h"
#include "shlight/light/window_name.h"
#include "tracing.h"

namespace shlight::viewer {
namespace {

// Of a frame, for what is brought to the card beside drawing.
constexpr double kUploadMs = 6, kAllMs = 1e9;

bool needs_tables(const Look& look) {
  return look.show != Show::kNormals && (look.method == Method::kReflectance || look.method == Method::kHybrid);
}
bool needs_transfer(const Look& look) {
  return look.show == Show::kVisibility || (look.show != Show::kNormals && look.method == Method::kTransfer);
}

// What was baked shadows what is drawn by tables, too, as `render` does it.
bool needs_shadows(const Subject& subject, const Look& look) {
  return subject.model->is_baked && needs_tables(look) && look.transfer != TransferKind::kCosine;
}

// The degree that is shown alone; -1 where all are.
int degree_of(const Look& look) {
  return look.show == Show::kDegree ? std::min(look.degree, look.bands - 1) : -1;
}

std::string text_of(const Rotation& rotation) {
  std::string text;
  for (const Vec3d& row : rotation.rows) text += fmt::format(" {} {} {}", row.x, row.y, row.z);
  return text;
}

// What a bake depends on. A baked file has its transfer already.
std::string bake_key(const Subject& subject, const Look& look) {
  if (subject.model->is_baked) return subject.model->key + " baked";
  const bool bounces = look.transfer == TransferKind::kInterreflected;
  return fmt::format("{} {} {} {} {}", subject.model->key, to_text(look.transfer), look.bands,
                     look.transfer == TransferKind::kCosine ? 0 : look.samples, bounces ? look.bounces : 0);
}

std::string table_key(const Subject& subject, const Look& look) {
  std::string key = fmt::format("{} {} {}", look.material.empty() ? subject.model->key : "", look.material, look.bands);
  // The cubes of the hybrid method are of the light.
  if (look.method == Method::kHybrid)
    key += fmt::format(" hybrid {} {} {}", subject.light->key, look.window, degree_of(look));
  return key;
}

std::string trace_key(const Subject& subject, const Settings& s, const Look& look, int width, int height) {
  std::string key = fmt::format("{} {} {} {} {} {} {} {} {} {} {}", subject.model->key, subject.light->key,
                                look.material, to_text(look.transfer), look.bounces, s.background, s.camera.azimuth,
                                s.camera.elevation, s.camera.zoom, width, height);
  key += fmt::format(" {} {} {}", s.camera.target.x, s.camera.target.y, s.camera.target.z);
  return key + text_of(s.rotate_light);
}

std::size_t bytes_of(const std::vector<SurfaceReflectance>& surfaces) {
  std::size_t floats = 0;
  for (const SurfaceReflectance& surface : surfaces) {
    if (surface.plain) floats += surface.plain->values.size();
    if (surface.tinted) floats += surface.tinted->values.size();
  }
  return floats * sizeof(float);
}

}  // namespace

void Side::request_tables(const Subject& subject, const Look& look) {
  const std::string key = table_key(subject, look);
  if ((tables_ && tables_->key == key) || key == cancelled_ || key == table_.wanted()) return;
  const bool hybrid = look.method == Method::kHybrid;
  RenderLight light;
  if (hybrid) light = {shaped_light(subject, look, look.bands), subject.light->drawn.background};
  if (const int degree = degree_of(look); degree >= 0) light = {keep_degree(light.coefficients, degree), {}};
  table_.request(
      key,
      [key, model = subject.model, look, hybrid, light = std::move(light)](const auto& publish,
                                                                           const Progress& progress) {
        ReflectanceTableParams params;
        params.bands = look.bands;
        params.threads = worker_threads();
        const Scene& scene = model->content.scene;
        auto tables = std::make_shared<Tables>();
        tables->key = key;
        if (look.material.empty())
          tables->surfaces = make_surface_reflectances(scene, params, hybrid, progress);
        else
          tables->surfaces = make_surface_reflectances(scene, *make_brdf(look.material), params, hybrid);
        if (hybrid)
          tables->highlights = make_highlight_light(tables->surfaces, light, look.bands, worker_threads(), progress);
        publish(tables);
      },
      false);
}

void Side::request_bake(const Subject& subject, const Look& look) {
  const std::string key = bake_key(subject, look);
  if (transfer_ && transfer_->key == key && transfer_->final) return;
  if (key == cancelled_) return;
  if (subject.model->is_baked) {
    const auto transfer = std::shared_ptr<const Transfer>(subject.model, &subject.model->content.transfer);
    transfer_ = std::make_shared<const BakedTransfer>(BakedTransfer{key, transfer, true});
    return;
  }
  bake_.request(
      key,
      [key, model = subject.model, look](const auto& publish, const Progress& progress) {
        BakeParams params;
        params.kind = look.transfer;
        params.bands = look.bands;
        params.bounces = look.bounces;
        params.threads = worker_threads();
        // A quick one to look at first.
        constexpr int kQuick = 32, kBetter = 256;
        const bool is_exact = look.transfer == TransferKind::kCosine;
        for (const int samples : {kQuick, kBetter, look.samples}) {
          const bool last = samples == look.samples;
          if (!last && (is_exact || (look.samples > 0 && samples >= look.samples))) continue;
          params.samples = is_exact ? 0 : samples;
          auto transfer =
              std::make_shared<const Transfer>(bake_transfer(model->content.scene, params, watch(progress)));
          publish(std::make_shared<const BakedTransfer>(BakedTransfer{key, transfer, last}));
          if (last) break;
        }
      },
      true);
}

// Of the light as it falls now: they are found anew while it turns.
void Side::request_shadows(const Subject& subject, const Settings& settings, const Look& look) {
  const int degree = degree_of(look);
  const std::string key = fmt::format("{} {} {} {} {}{}", subject.model->key, subject.light->key, look.window,
                                      look.bands, degree, text_of(settings.rotate_light));
  if (key == shadow_.wanted()) return;
  RgbCoefficients light = shaped_light(subject, look, look.bands);
  if (degree >= 0) light = keep_degree(light, degree);
  shadow_.request(
      key,
      [model = subject.model, light = rotate(settings.rotate_light, light)](const auto& publish, const Progress&) {
        publish(
            std::make_shared<const Shadows>(Shadows{model->key, model->shadow_ratio().under(light, worker_threads())}));
      },
      false);
}

void Side::request_trace(const Subject& subject, const Settings& settings, const Look& look) {
  PathTraceParams params;
  params.width = width_, params.height = height_;
  params.camera = settings.camera;
  params.rotate_light = settings.rotate_light;
  params.transfer = look.transfer;
  params.bounces = look.bounces;
  params.show_background = settings.background;
  params.threads = worker_threads();
  trace_.request(
      trace_key(subject, settings, look, width_, height_),
      [model = subject.model, light = subject.light, look, params](const auto& publish, const Progress& progress) {
        PathTraceParams with_brdf = params;
        const auto brdf = look.material.empty() ? nullptr : make_brdf(look.material);
        with_brdf.brdf = brdf.get();
        trace_ever_finer(*model, *light, with_brdf, publish, progress);
      },
      true);
}

bool Side::take_news() {
  bool news = false;
  if (auto tables = table_.poll()) {
    if (tables->result) tables_ = *tables->result, news = true;
    if (!tables->error.empty()) error_ = tables->error;
  }
  if (auto bake = bake_.poll()) {
    if (bake->result) transfer_ = *bake->result, news = true;
    if (!bake->error.empty()) error_ = bake->error;
  }
  if (auto shadow = shadow_.poll()) {
    if (shadow->result) {
      shadows_ = std::make_shared<const GpuShadows>((*shadow->result)->of_vertices);
      shadows_model_ = (*shadow->result)->model;
      news = true;
    }
    if (!shadow->error.empty()) error_ = shadow->error;
  }
  if (auto trace = trace_.poll()) {
    if (trace->result && trace->key == trace_.wanted()) {
      traced_ = std::move(*trace->result);
      traced_key_ = trace->key;
      noise_ = relative_noise(traced_);
      news = true;
    }
    if (!trace->error.empty()) error_ = trace->error;
  }
  return news;
}

// Windows that look for how much is enough take a while, so that is kept.
const RgbCoefficients& Side::shaped_light(const Subject& subject, const Look& look, int bands) {
  const std::string key = fmt::format("{} {} {}", subject.light->key, look.window, bands);
  if (key == shaped_key_) return shaped_;
  const RgbCoefficients first = resize_bands(subject.light->drawn.coefficients, bands);
  shaped_ = look.window == "none" ? first : apply_named_window(look.window, first).coefficients;
  shaped_key_ = key;
  return shaped_;
}

// Makes a renderer of the look where what it needs is there; of irradiance where there is nothing yet. True where there
// is a new one to draw with.
bool Side::build_renderer(const Subject& subject, const Look& look) {
  const bool tables_ready = needs_tables(look) && tables_ && tables_->key == table_key(subject, look);
  const bool transfer_ready = needs_transfer(look) && transfer_ && transfer_->key == bake_key(subject, look);
  const bool needs_neither = !needs_tables(look) && !needs_transfer(look);
  const bool fallback = !tables_ready && !transfer_ready && !needs_neither;
  const bool is_of_model = renderer_ && built_.model == subject.model->key;
  if (fallback && is_of_model) return false;

  Built built = {{}, subject.model->key, look.bands, fallback ? Show::kLit : look.show, 0};
  built.key = fmt::format("{} {} {}", subject.model->key, look.bands, static_cast<int>(look.show));
  if (tables_ready)
    built.key += fmt::format(" {} {}", static_cast<const void*>(tables_.get()), static_cast<int>(look.shade));
  if (transfer_ready) built.key += fmt::format(" {}", static_cast<const void*>(transfer_.get()));
  if (upcoming_ && built.key == upcoming_->built.key) return upload(kUploadMs);
  upcoming_.reset();
  if (built.key == built_.key) return false;

  const bool lit = look.show == Show::kLit || look.show == Show::kDegree;
  const LightScale scale = lit || fallback ? light_scale(subject.light->drawn.coefficients) : LightScale{};
  const RgbCoefficients light = scaled(scale.unit, shaped_light(subject, look, look.bands));
  if (look.show == Show::kNormals) {
    install(NormalRenderer(), built);
  } else if (transfer_ready) {
    const Baked& content = subject.model->content;
    built.bytes = transfer_->transfer->coefficients.size() * sizeof(float);
    if (subject.model->is_baked && content.info.pca) {
      install(TransferRenderer(*content.info.pca, resize_bands(light, content.info.pca->bands)), built);
    } else {
      const int bits = subject.model->is_baked ? content.info.bits : 32;
      upcoming_ = {TransferRenderer::make_empty(*transfer_->transfer, light, bits), transfer_->transfer, built};
      return upload(is_of_model ? kUploadMs : kAllMs);  // what is drawn until then has to be of the model
    }
  } else if (tables_ready) {
    built.bytes = bytes_of(tables_->surfaces);
    install(ReflectanceRenderer(tables_->surfaces, light, look.shade,
                                tables_->highlights ? &*tables_->highlights : nullptr, scale.unit),
            built);
  } else {
    built.bytes = 3 * sizeof(float) * light.size();
    install(IrradianceRenderer(light), built);
  }
  return true;
}

bool Side::upload(double ms) {
  const auto start = std::chrono::steady_clock::now();
  do {
    if (!upcoming_->renderer.upload(*upcoming_->transfer)) continue;
    install(std::move(upcoming_->renderer), upcoming_->built);
    upcoming_.reset();
    return true;
  } while (std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() < ms);
  return false;
}

void Side::install(SurfaceRenderer renderer, const Built& built) {
  begun_.reset();
  renderer_.emplace(std::move(renderer));
  built_ = built;
  light_key_.clear();
}

// Gives the renderer and the background the light as it is now.
void Side::refresh_light(const Subject& subject, const Look& look) {
  const bool lit = built_.show == Show::kLit || built_.show == Show::kDegree;
  const std::string key =
      fmt::format("{} {} {} {}", subject.light->key, look.window, built_.show == Show::kDegree ? look.degree : -1, lit);
  if (key == light_key_) return;
  light_key_ = key;
  scale_ = lit ? light_scale(subject.light->drawn.coefficients) : LightScale{};
  light_ = shaped_light(subject, look, built_.bands);
  if (built_.show == Show::kDegree) light_ = keep_degree(light_, std::min(look.degree, built_.bands - 1));
  const RgbCoefficients drawn = lit ? scaled(scale_.unit, light_) : visibility_light(built_.bands);
  set_radiance(*renderer_, drawn);

  const bool has_picture = subject.light->drawn.background.num_pixels() > 0 && built_.show == Show::kLit;
  const std::string background_key = has_picture ? subject.light->key : key;
  if (background_key == background_key_ || !lit) return;
  background_key_ = background_key;
  if (has_picture)
    background_.emplace(subject.light->behind);
  else
    background_.emplace(drawn);
}

bool Side::update(const Subject& subject, const Settings& settings, const Look& look, int width, int height) {
  const bool resized = width != width_ || height != height_;
  width_ = width, height_ = height;
  bool changed = take_news() || resized;
  if (look.method == Method::kReference) {
    request_trace(subject, settings, look);
  } else {
    trace_.cancel();
    if (needs_tables(look)) request_tables(subject, look);
    if (needs_transfer(look)) request_bake(subject, look);
    if (!needs_transfer(look)) bake_.cancel();
    if (needs_shadows(subject, look))
      request_shadows(subject, settings, look);
    else
      shadow_.cancel();
    changed = build_renderer(subject, look) || changed;
  }
  return changed;
}

void Side::show_trace(const Subject& subject, const Settings& settings) {
  if (!traced_picture_ || traced_picture_->width() != width_ || traced_picture_->height() != height_)
    traced_picture_.emplace(width_, height_);
  const LightScale scale = light_scale(subject.light->drawn.coefficients);
  traced_picture_->set(traced_.radiance, scale.unit);
  traced_picture_->draw(exposed(scale, {{}, {}, settings.exposure, settings.curve}), settings.curve);
  showing_trace_ = true;
}

void Side::begin_picture(const Subject& subject, const Settings& settings, const Look& look, int coarseness) {
  begun_.reset();
  const bool reference = look.method == Method::kReference;
  if (reference && traced_.radiance.num_pixels() > 0) return show_trace(subject, settings);
  if (reference) {  // until there are paths
    Look plain = look;
    plain.method = Method::kIrradiance;
    plain.show = Show::kLit;
    build_renderer(subject, plain);
  }
  if (!renderer_) return;
  refresh_light(subject, look);
  const int width = std::max(width_ / coarseness, 1), height = std::max(height_ / coarseness, 1);
  const auto same_size = canvases_.find(coarseness);
  if (same_size != canvases_.end() &&
      (same_size->second.frame.width() != width || same_size->second.frame.height() != height)) {
    // What is shown stays until there is something else.
    if (shown_canvases_.empty()) shown_canvases_ = std::move(canvases_);
    canvases_.clear();
  }
  Canvas& canvas = canvases_.try_emplace(coarseness, width, height).first->second;
  const bool lit = built_.show == Show::kLit || built_.show == Show::kDegree;
  const FrameParams params = {settings.camera, settings.rotate_light, lit ? settings.exposure : 0,
                              lit ? settings.curve : ToneCurve::kNone};
  const float bright = look.mark_negative ? static_cast<float>(1 / exposed(scale_, params)) : 0;
  mark_negative(*renderer_, {bright, 0, bright});
  GpuScene& scene = subject.gpu->get(needs_tangents(*renderer_), built_.show != Show::kVisibility);
  const bool has_shadows = needs_shadows(subject, look) && shadows_model_ == subject.model->key;
  begun_ = {subject.gpu,
            &scene,
            settings.background && lit ? &*background_ : nullptr,
            has_shadows ? shadows_ : nullptr,
            params,
            &canvas,
            coarseness};
  canvas.parts.begin(scene);
}

bool Side::draw(double ms) {
  if (!begun_) return false;
  auto& [gpu, scene, background, shadows, params, canvas, coarseness] = *begun_;
  scene->set_shadows(shadows.get());  // the other side draws the same scene with its own
  const Drawing drawing = {*scene, gpu->asset().extent, *renderer_, background, scale_};
  const bool is_complete = canvas->parts.draw(*scene, drawing, params, ms);
  scene->set_shadows(nullptr);
  if (!is_complete) return false;
  cost_ = {coarseness, canvas->parts.spent_ms()};
  frame_ = &canvas->frame;
  shown_canvases_.clear();
  radiance_.reset();
  showing_trace_ = false;
  begun_.reset();
  return true;
}

unsigned Side::texture() const {
  if (showing_trace_) return traced_picture_->texture();
  return frame_ ? frame_->texture() : 0;
}

bool Side::has_picture() const {
  return showing_trace_ || frame_;
}

Image8 Side::read_picture() const {
  return showing_trace_ ? traced_picture_->read_picture() : frame_->read_picture();
}

// Kept, as a converging reference is compared with the same picture again and again.
const Image& Side::read_radiance() const {
  if (showing_trace_) return traced_.radiance;
  if (!radiance_) radiance_ = frame_->read_radiance();
  return *radiance_;
}

bool Side::settled(const Look& look) const {
  if (look.method == Method::kReference) return traced_.samples > 0 && traced_key_ == trace_.wanted();
  return !table_.busy() && !bake_.busy() && !shadow_.busy() && !upcoming_;
}

std::string Side::activity() const {
  // What was cancelled and has not ended yet is nobody's business.
  const auto works = [](const auto& task) { return task.busy() && !task.wanted().empty(); };
  if (works(bake_)) return fmt::format("baking, {:.0f} %", 100 * bake_.fraction());
  if (works(table_)) return "computing how it reflects";
  if (works(trace_)) return traced_.samples > 0 ? fmt::format("{} paths a pixel", traced_.samples) : "tracing";
  return "";
}

double Side::fraction() const {
  return bake_.busy() ? bake_.fraction() : trace_.busy() ? trace_.fraction() : table_.fraction();
}

void Side::cancel() {
  cancelled_ = bake_.busy() ? bake_.wanted() : table_.wanted();
  bake_.cancel();
  table_.cancel();
}

std::optional<std::string> Side::take_error() {
  return std::exchange(error_, {});
}

}  // namespace shlight::viewer
