#include "shlight/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <system_error>

#include "shlight/core/assert.h"
#include "shlight/core/error.h"
#include "shlight/core/file.h"
#include "shlight/report/html.h"
#include "shlight/report/machine.h"
#include "shlight/report/page.h"
#include "shlight/report/part.h"
#include "shlight/truth/svg.h"

namespace shlight {
namespace {

std::vector<PartRecipe> all_recipes() {
  std::vector<PartRecipe> all;
  for (auto recipes :
       {basis_recipes, irradiance_recipes, reflectance_recipes, table_recipes, claim_recipes, errata_recipes})
    for (PartRecipe& recipe : recipes()) all.push_back(std::move(recipe));
  return all;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) throw Error(folder.string(), "cannot be made (" + failed.message() + ")", "a folder in a writable place");
}

// Makes one part and returns its HTML; what goes wrong is noted down.
std::string make_part(const PartRecipe& recipe, ReportSources& sources, const std::filesystem::path& folder,
                      const Progress& progress, ReportPart& part) {
  const auto start = std::chrono::steady_clock::now();
  PartWriter writer(folder, part, progress);
  std::string html;
  try {
    report_progress(progress, 0);
    recipe.make(sources, writer);
    html = writer.html();
  } catch (const Cancelled& cancelled) {
    part.missing = cancelled.what();
  } catch (const std::bad_alloc&) {
    part.missing = "out of memory";
  } catch (const std::exception& error) {
    part.missing = error.what();
  }
  part.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (part.missing.empty()) return html;
  return fmt::format("<p class=\"missing\"><b>{} is missing.</b> {}</p>\n", escape_xml(recipe.title),
                     escape_xml(part.missing));
}

}  // namespace

std::vector<const ReportPart*> Report::missing() const {
  std::vector<const ReportPart*> list;
  for (const ReportPart& part : parts)
    if (!part.missing.empty()) list.push_back(&part);
  return list;
}

Report reproduce_thesis(const std::filesystem::path& folder, const ReportParams& params, const ReportWatcher& watcher) {
  SHLIGHT_ASSERT_GE(params.samples, 9);
  Report report;
  report.page = folder / "thesis.html";
  report.processor = describe_processor();
  make_folder(folder);
  check_writable(report.page);

  ReportSources sources(params);
  const std::vector<PartRecipe> recipes = all_recipes();
  double weight = 0, done = 0;
  for (const PartRecipe& recipe : recipes) weight += recipe.weight;
  std::map<std::string, std::string> html;
  bool stopped = false;
  for (const PartRecipe& recipe : recipes) {
    ReportPart& part = report.parts.emplace_back();
    part.id = recipe.id, part.title = recipe.title;
    const Progress progress = [&](double fraction) {
      stopped = stopped || (watcher && !watcher(recipe.title, (done + fraction * recipe.weight) / weight));
      return !stopped;
    };
    html[recipe.id] = make_part(recipe, sources, folder, progress, part);
    done += recipe.weight;
  }
  write_file(report.page, make_page(report, params, html));
  if (stopped) throw Cancelled();
  if (watcher) watcher("the page", 1);
  return report;
}

}  // namespace shlight
