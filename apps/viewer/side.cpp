#include "side.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "shlight/brdf/make_brdf.h"
#include "tracing.h"

namespace shlight::viewer {
namespace {

bool needs_tables(const Look& look) {
  const bool lit = look.show == Show::kLit || look.show == Show::kDegree;
  return lit && (look.method == Method::kReflectance || look.method == Method::kHybrid);
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

}  // namespace

Side::~Side() {
  if (awaited_) *awaited_->stop = true;
}

void Side::draw_on(GlThread& thread) {
  thread_ = &thread;
  painter_ = thread.own(std::make_unique<Painter>(thread));
}

void Side::request_tables(const Subject& subject, const Look& look) {
  const std::string key = table_key(subject, look);
  if ((tables_ && tables_->key == key) || key == cancelled_ || key == table_.wanted()) return;
  table_.request(
      key,
      [key, model = subject.model, asset = subject.light, look](const auto& publish, const Progress& progress) {
        const bool hybrid = look.method == Method::kHybrid;
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
        if (hybrid) {
          RenderLight light = {shaped_light(*asset, look.window, look.bands), asset->drawn.background};
          if (const int degree = degree_of(look); degree >= 0) light = {keep_degree(light.coefficients, degree), {}};
          tables->highlights = make_highlight_light(tables->surfaces, light, look.bands, worker_threads(), progress);
        }
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
  shadow_.request(
      key,
      [model = subject.model, asset = subject.light, look, degree, rotation = settings.rotate_light](
          const auto& publish, const Progress&) {
        RgbCoefficients light = shaped_light(*asset, look.window, look.bands);
        if (degree >= 0) light = keep_degree(light, degree);
        publish(std::make_shared<const Shadows>(
            Shadows{model->key, model->shadow_ratio().under(rotate(rotation, light), worker_threads())}));
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
        const auto publish_with_noise = [&](PathTraceResult result) {
          const double noise = relative_noise(result);
          publish(std::make_shared<const Traced>(Traced{std::move(result), noise}));
        };
        trace_ever_finer(*model, *light, with_brdf, publish_with_noise, progress);
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
    if (shadow->result) shadows_ = *shadow->result, news = true;
    if (!shadow->error.empty()) error_ = shadow->error;
  }
  if (auto trace = trace_.poll()) {
    if (trace->result && trace->key == trace_.wanted()) {
      traced_ = *trace->result;
      traced_key_ = trace->key;
      news = true;
    }
    if (!trace->error.empty()) error_ = trace->error;
  }
  return news;
}

// Of the look where what it needs is there; of irradiance where there is nothing yet. True where it is a new one.
bool Side::choose_renderer(const Subject& subject, const Look& look) {
  const bool tables_ready = needs_tables(look) && tables_ && tables_->key == table_key(subject, look);
  const bool transfer_ready = needs_transfer(look) && transfer_ && transfer_->key == bake_key(subject, look);
  const bool fallback = !tables_ready && !transfer_ready && (needs_tables(look) || needs_transfer(look));
  if (fallback && renderer_.model == subject.model) return false;

  RendererSpec spec = {{}, subject.model, look.bands, fallback ? Show::kLit : look.show, look.shade, {}, {}};
  spec.key = fmt::format("{} {} {}", subject.model->key, look.bands, static_cast<int>(spec.show));
  if (tables_ready) {
    spec.tables = tables_;
    spec.key += fmt::format(" {} {}", static_cast<const void*>(tables_.get()), static_cast<int>(look.shade));
  }
  if (transfer_ready) {
    spec.transfer = transfer_;
    spec.key += fmt::format(" {}", static_cast<const void*>(transfer_.get()));
  }
  if (spec.key == renderer_.key) return false;
  renderer_ = std::move(spec);
  return true;
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
    changed = choose_renderer(subject, look) || changed;
  }
  return changed;
}

void Side::begin_picture(const Subject& subject, const Settings& settings, const Look& look, int coarseness) {
  PictureRequest request;
  if (look.method == Method::kReference) {
    request.traced = traced_;
    Look plain = look;  // until there are paths
    plain.method = Method::kIrradiance;
    plain.show = Show::kLit;
    choose_renderer(subject, plain);
  }
  request.gpu = subject.gpu;
  request.light = subject.light;
  request.renderer = renderer_;
  if (needs_shadows(subject, look) && shadows_ && shadows_->model == subject.model->key) request.shadows = shadows_;
  request.window = look.window;
  request.degree = look.degree;
  request.mark_negative = look.mark_negative;
  request.background = settings.background;
  request.frame = {settings.camera, settings.rotate_light, settings.exposure, settings.curve};
  request.width = width_, request.height = height_;
  request.coarseness = coarseness;

  if (awaited_) *awaited_->stop = true;
  auto stop = std::make_shared<std::atomic<bool>>(false);
  auto picture = thread_->run([painter = painter_, request = std::move(request), stop] {
    return painter->paint(request, [&](double) { return !*stop; });
  });
  awaited_ = Awaited{std::move(picture), std::move(stop), coarseness};
}

void Side::wait_for_picture(double ms) const {
  if (awaited_) awaited_->picture.wait_for(std::chrono::duration<double, std::milli>(ms));
}

bool Side::take_picture() {
  if (!awaited_ || !is_ready(awaited_->picture)) return false;
  Awaited awaited = std::move(*awaited_);
  awaited_.reset();
  try {
    previous_ = std::exchange(picture_, awaited.picture.get());
    return true;
  } catch (const Error& error) {  // what the card cannot hold: the last picture stays
    error_ = error.what();
    return false;
  }
}

Image8 Side::read_picture() const {
  return thread_->run([target = picture_.target] { return target->read(); }).get();
}

Image Side::read_radiance() const {
  if (picture_.traced) return picture_.traced->result.radiance;
  return thread_->run([painter = painter_] { return painter->read_radiance(); }).get();
}

bool Side::settled(const Look& look) const {
  if (look.method == Method::kReference) return traced_samples() > 0 && traced_key_ == trace_.wanted();
  return !table_.busy() && !bake_.busy() && !shadow_.busy();
}

std::string Side::activity() const {
  // What was cancelled and has not ended yet is nobody's business.
  const auto works = [](const auto& task) { return task.busy() && !task.wanted().empty(); };
  if (works(bake_)) return fmt::format("baking, {:.0f} %", 100 * bake_.fraction());
  if (works(table_)) return "computing how it reflects";
  if (works(trace_))
    return traced_samples() > 0
               ? fmt::format("{} paths a pixel, noise {:.2g} %", traced_samples(), 100 * traced_->noise)
               : "tracing";
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
