#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>

#include "shlight/brdf/make_brdf.h"
#include "shlight/report/html.h"
#include "shlight/report/part.h"
#include "shlight/report/picture.h"
#include "shlight/report/thesis_materials.h"

// Figures 24 to 38: reflection models beside each other, and by three, five and eight bands beside the truth.

namespace shlight {
namespace {

constexpr const char* kModel = "builtin:knot";

// What the figures of one light share.
struct Studio {
  const Scene& scene;
  const Light& light;
  RenderLight render_light;
  RenderParams params;
  int fine;         // see draw_fine
  int square_size;  // of anisotropic tables
  Image backdrop;
  double exposure;
};

Studio make_studio(ReportSources& sources) {
  const Light& light = sources.light();
  RenderParams params;
  params.width = sources.pick(128, 320), params.height = params.width;
  params.camera = {20, 12, 1.1};
  params.show_background = false;
  RenderLight render_light = make_render_light(light, kMaxRenderBands);
  const Scene& scene = sources.scene(kModel);
  const int fine = sources.pick(2, 3);
  Image backdrop = draw_backdrop(scene, render_light, params, fine);
  const double exposure = auto_exposure(render_light.coefficients);
  return {scene, light, std::move(render_light), params, fine, sources.pick(48, 128), std::move(backdrop), exposure};
}

// The one of all parts, made by the first that asks for it.
class SharedStudio {
 public:
  const Studio& get(ReportSources& sources) {
    if (!studio_) studio_ = std::make_unique<Studio>(make_studio(sources));
    return *studio_;
  }

 private:
  std::unique_ptr<Studio> studio_;
};

std::string add_shown(PartWriter& out, const Studio& studio, const std::string& id, const std::string& title,
                      const Image& radiance) {
  return out.add_picture(id, make_picture8(add_images(radiance, studio.backdrop), studio.exposure), title);
}

Image draw_reflectance(const Studio& studio, const Brdf& brdf, int bands) {
  ReflectanceTableParams table;
  table.bands = bands;
  table.square_size = studio.square_size;
  const auto surfaces = make_surface_reflectances(studio.scene, brdf, table);
  RenderParams params = studio.params;
  params.bands = bands;
  return draw_fine(studio.render_light, params, studio.fine, [&](const RenderLight& light, const RenderParams& p) {
    return render_reflectance(studio.scene, surfaces, light, p);
  });
}

Reference trace_material(const Studio& studio, const Brdf& brdf, ReportSources& sources, const Progress& progress) {
  return trace_reference(studio.scene, studio.light, studio.params, &brdf, sources.pick(32, 256), progress);
}

// Two materials side by side, with how far they are from each other.
struct Pair {
  const char *part, *part_title;
  std::array<const char*, 2> id, title, material;
};

void make_pair(const Pair& pair, SharedStudio& shared, ReportSources& sources, PartWriter& out) {
  const Studio& studio = shared.get(sources);
  const int bands = sources.pick(5, 8);
  std::string html = "<div class=\"group two\">\n";
  std::array<Reference, 2> truths;
  for (std::size_t i = 0; i < 2; ++i) {
    const Progress half = [&](double fraction) {
      report_progress(out.progress(), (static_cast<double>(i) + fraction) / 2);
      return true;
    };
    const auto brdf = make_brdf(pair.material[i]);
    const Image drawn = draw_reflectance(studio, *brdf, bands);
    truths[i] = trace_material(studio, *brdf, sources, half);
    const PictureError error = measure_picture(drawn, truths[i]);
    add_error(out, pair.id[i], error);
    html += html_figure(add_shown(out, studio, pair.id[i], pair.title[i], drawn),
                        {fmt::format("<b>{}.</b>", pair.title[i]),
                         fmt::format("<code>{}</code>, {} bands, error {}", pair.material[i], bands, to_text(error))});
  }
  const PictureError difference = measure_difference(truths[0], truths[1]);
  add_error(out, "difference", difference);
  out.add_html(html + "</div>\n");
  out.add_html(fmt::format("<p>The two materials themselves, path traced, differ by {}.</p>\n", to_text(difference)));
}

// One material by three, five and eight bands and path traced.
void make_row(const ThesisMaterial& material, int first_figure, SharedStudio& shared, ReportSources& sources,
              PartWriter& out) {
  const Studio& studio = shared.get(sources);
  const auto brdf = make_brdf(material.text);
  const Reference truth = trace_material(studio, *brdf, sources, out.progress());
  std::string html = "<div class=\"group four\">\n";
  HtmlTable table = {{"bands", "relative_error", "resolution"}, {}};
  for (const int bands : {3, 5, 8}) {
    const Image drawn = draw_reflectance(studio, *brdf, bands);
    const PictureError error = measure_picture(drawn, truth);
    const std::string figure = bands == 8 ? "" : fmt::format("Figure {}. ", first_figure + (bands == 5));
    const std::string title = fmt::format("{}{}, {} bands", figure, material.name, bands);
    add_error(out, fmt::format("bands_{}", bands), error);
    table.rows.push_back(
        {fmt::format("{}", bands), fmt::format("{:.6g}", error.value), fmt::format("{:.6g}", error.resolution)});
    html += html_figure(add_shown(out, studio, fmt::format("{}-{}-bands", material.id, bands), title, drawn),
                        {"<b>" + title + ".</b>", "error " + to_text(error)});
  }
  out.add_value("reference_noise", truth.noise);
  out.add_csv(material.id, csv_table(table));
  html += html_figure(add_shown(out, studio, std::string(material.id) + "-reference", "The reference", truth.radiance),
                      {"<b>The truth</b>, path traced.", fmt::format("noise {}", format_percent(truth.noise))});
  out.add_html(html + "</div>\n");
}

}  // namespace

std::vector<PartRecipe> reflectance_recipes() {
  static constexpr Pair kPairs[] = {
      {"figures-24-25",
       "Figures 24 and 25: Oren-Nayar beside Lambert",
       {"figure-24", "figure-25"},
       {"Figure 24. Oren-Nayar", "Figure 25. Lambert"},
       {"oren-nayar:rho=0.8,sigma=0.8", "lambert:rho=0.8"}},
      {"figures-26-27",
       "Figures 26 and 27: Ward, anisotropic beside isotropic",
       {"figure-26", "figure-27"},
       {"Figure 26. Ward, anisotropic", "Figure 27. Ward, isotropic"},
       {"ward-aniso:rd=0.1,rs=0.6,sx=0.15,sy=0.6", "ward:rd=0.1,rs=0.6,sigma=0.3"}},
      {"figures-28-29",
       "Figures 28 and 29: Cook-Torrance of two roughnesses",
       {"figure-28", "figure-29"},
       {"Figure 28. Cook-Torrance, m = 0.5", "Figure 29. Cook-Torrance, m = 0.6"},
       {"cook-torrance:m=0.5,f0=0.9", "cook-torrance:m=0.6,f0=0.9"}},
  };
  const auto studio = std::make_shared<SharedStudio>();
  std::vector<PartRecipe> recipes;
  for (const Pair& pair : kPairs)
    recipes.push_back({pair.part, pair.part_title, 8, [&pair, studio](ReportSources& sources, PartWriter& out) {
                         make_pair(pair, *studio, sources, out);
                       }});
  int figure = 31;
  for (const ThesisMaterial& material : thesis_materials()) {
    recipes.push_back({fmt::format("figures-{}-{}", figure, figure + 1),
                       fmt::format("Figures {} and {}: {} by 3, 5 and 8 bands", figure, figure + 1, material.name), 10,
                       [&material, figure, studio](ReportSources& sources, PartWriter& out) {
                         make_row(material, figure, *studio, sources, out);
                       }});
    figure += 2;
  }
  return recipes;
}

}  // namespace shlight
