#include "shlight/report/page.h"

#include <fmt/format.h>

#include <string_view>

#include "page_text.h"
#include "shlight/core/assert.h"
#include "shlight/truth/svg.h"

namespace shlight {
namespace {

// What the report was made from and on, and what is missing.
std::string describe_report(const Report& report, const ReportParams& params) {
  std::string models;
  for (const std::string& model : params.models) models += (models.empty() ? "" : ", ") + escape_xml(model);
  std::string html = fmt::format(
      "<p class=\"made\">Light: {}. Models: {}. {} samples where the thesis takes 10 000. Measured on {}{}.</p>\n",
      escape_xml(params.light), models.empty() ? "built-in ones" : models, params.samples, escape_xml(report.processor),
      params.quick ? ", a quick report: small pictures, noisier references, fewer sizes, lights and bands" : "");
  const auto missing = report.missing();
  if (missing.empty()) return html;
  html += "<div class=\"missing\"><b>This report is not complete.</b><ul>\n";
  for (const ReportPart* part : missing)
    html += fmt::format("<li><a href=\"#{}\">{}</a>: {}</li>\n", part->id, escape_xml(part->title),
                        escape_xml(part->missing));
  return html + "</ul></div>\n";
}

}  // namespace

std::string make_page(const Report& report, const ReportParams& params,
                      const std::map<std::string, std::string>& html) {
  std::map<std::string, std::string> pieces;
  for (const auto& [id, part] : html) pieces[id] = fmt::format("<div class=\"part\" id=\"{}\">\n{}</div>\n", id, part);
  pieces["style"] = page_text::style_css;
  pieces["report"] = describe_report(report, params);
  std::string page;
  std::string_view rest = page_text::thesis_html;
  for (std::size_t open; (open = rest.find("{{")) != std::string_view::npos;) {
    page += rest.substr(0, open);
    const std::size_t close = rest.find("}}", open);
    SHLIGHT_ASSERT_LT(close, rest.size());
    const std::string name(rest.substr(open + 2, close - open - 2));
    SHLIGHT_ASSERT_EQ(pieces.count(name), std::size_t{1});
    page += pieces[name];
    pieces.erase(name);
    rest.remove_prefix(close + 2);
  }
  SHLIGHT_ASSERT_EQ(pieces.size(), std::size_t{0});  // each part has its place
  return page.append(rest);
}

}  // namespace shlight
