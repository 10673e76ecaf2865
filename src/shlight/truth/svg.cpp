#include "shlight/truth/svg.h"

#include <fmt/format.h>

namespace shlight {
namespace {

// Colours that stand out from white and from nearly black; the page is the reader's.
constexpr const char* kStyle =
    ".page{fill:#ffffff}.grid{stroke:#dddddd}.axis{stroke:#666666;fill:none}.ink{fill:#222222}.faint{fill:#666666}"
    "text{font:12px 'DejaVu Sans',Verdana,sans-serif}.curve{fill:none;stroke-width:2}";
constexpr const char* kDarkStyle =
    ".page{fill:#15181c}.grid{stroke:#343a41}.axis{stroke:#9aa3ad}.ink{fill:#e8e8e8}.faint{fill:#a9b0b8}";

}  // namespace

std::string escape_xml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else if (static_cast<unsigned char>(c) >= ' ')
      escaped += c;
  }
  return escaped;
}

std::string svg_text(double x, double y, std::string_view style, std::string_view anchor, std::string_view content) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\" text-anchor=\"{}\">{}</text>\n", x, y, style, anchor,
                     escape_xml(content));
}

std::string svg_line(double x1, double y1, double x2, double y2, std::string_view style) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", x1, y1, x2, y2,
                     style);
}

std::string svg_begin(double width, double height, std::string_view style, std::string_view dark_style) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\">\n"
      "<style>{2}{3}@media(prefers-color-scheme:dark){{{4}{5}}}</style>\n"
      "<rect width=\"{0:g}\" height=\"{1:g}\" class=\"page\"/>\n",
      width, height, kStyle, style, kDarkStyle, dark_style);
}

}  // namespace shlight
