#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "shlight/core/progress.h"
#include "shlight/image/image.h"
#include "shlight/report/report.h"
#include "shlight/scene/scene.h"

// What a part of the report is made from, and what it becomes. Not installed.

namespace shlight {

// The light and the models that parts share. Each is loaded when it is first asked for; one that cannot be loaded fails
// the parts that ask for it and no others.
class ReportSources {
 public:
  explicit ReportSources(ReportParams params) : params_(std::move(params)) {}

  const ReportParams& params() const { return params_; }
  // Throws Error, each time alike.
  const Light& light();
  const Scene& scene(const std::string& model);
  // The scene of figures 17 to 22.
  std::string figure_model() const { return params_.models.empty() ? "builtin:scene" : params_.models.front(); }
  // What of two settings fits: of a quick report, or of a whole one.
  template <class T>
  T pick(T quick, T whole) const {
    return params_.quick ? quick : whole;
  }

 private:
  ReportParams params_;
  std::unique_ptr<Light> light_;
  std::map<std::string, Scene> scenes_;
};

// A part while it is made: HTML for the page, files beside it, and values.
class PartWriter {
 public:
  PartWriter(std::filesystem::path folder, ReportPart& part, Progress progress)
      : folder_(std::move(folder)), part_(part), progress_(std::move(progress)) {}

  void add_html(std::string_view html) { html_ += html; }
  void add_value(std::string name, double value) { part_.values.push_back({std::move(name), value, false}); }
  void add_time(std::string name, double value) { part_.values.push_back({std::move(name), value, true}); }

  // Each writes a file and returns the <img> that shows it inside of the page. Throws Error.
  std::string add_picture(const std::string& name, const Image8& picture, std::string_view alternative);
  std::string add_plot(const std::string& name, const std::string& svg, std::string_view alternative);
  void add_csv(const std::string& name, const std::string& csv);

  // How far the part is; throws Cancelled where the report is to stop.
  const Progress& progress() const { return progress_; }
  const std::string& html() const { return html_; }

 private:
  std::filesystem::path folder_;
  ReportPart& part_;
  Progress progress_;
  std::string html_;
};

// A part that can be made. The page has {{id}} where it stands.
struct PartRecipe {
  std::string id, title;
  double weight = 1;  // how long it takes, against others, for progress alone
  std::function<void(ReportSources&, PartWriter&)> make;
};

// In the sequence of the page, one list a file.
std::vector<PartRecipe> basis_recipes();        // figures 10 to 16
std::vector<PartRecipe> irradiance_recipes();   // figures 17 to 22
std::vector<PartRecipe> reflectance_recipes();  // figures 24 to 38
std::vector<PartRecipe> table_recipes();        // tables 1 to 4
std::vector<PartRecipe> claim_recipes();
std::vector<PartRecipe> errata_recipes();

}  // namespace shlight
