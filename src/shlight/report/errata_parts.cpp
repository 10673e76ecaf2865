#include <fmt/format.h>

#include <cmath>

#include "shlight/core/error.h"
#include "shlight/report/errata.h"
#include "shlight/report/html.h"
#include "shlight/report/part.h"

// The list of errata, each with its numbers.

namespace shlight {
namespace {

std::string number(double value) {
  if (std::isinf(value)) return "∞";
  std::string text = fmt::format("{:.5g}", std::abs(value) < 1e-12 ? 0 : value);
  if (text[0] == '-') text.replace(0, 1, "−");
  return text;
}

void make_errata(const std::vector<Erratum>& errata, const std::string& name, PartWriter& out) {
  HtmlTable table = {{"chapter", "printed", "should be", "demonstrated on", "as printed", "corrected", "true"}, {}};
  for (const Erratum& erratum : errata) {
    if (!erratum.shown())
      throw Error("erratum " + erratum.id, "its numbers do not show it", "a corrected formula that holds");
    table.rows.push_back({erratum.chapter, erratum.printed, erratum.corrected, erratum.quantity,
                          erratum.printed_value ? number(*erratum.printed_value) : "none",
                          number(erratum.corrected_value),
                          fmt::format("{}{}<br><small>{}</small>", erratum.at_most ? "≤ " : "",
                                      number(erratum.true_value), erratum.truth)});
    if (erratum.printed_value && std::isfinite(*erratum.printed_value))
      out.add_value(erratum.id + "_printed", *erratum.printed_value);
    out.add_value(erratum.id + "_corrected", erratum.corrected_value);
    out.add_value(erratum.id + "_true", erratum.true_value);
  }
  out.add_csv(name, csv_table(table));
  out.add_html("<div class=\"errata\">" + html_table(table) + "</div>\n");
}

}  // namespace

std::vector<PartRecipe> errata_recipes() {
  return {{"errata-harmonics", "Errata of chapters 3 to 7", 0.5,
           [](ReportSources&, PartWriter& out) { make_errata(harmonic_errata(), "errata-harmonics", out); }},
          {"errata-reflection", "Errata of chapter 8", 0.5,
           [](ReportSources&, PartWriter& out) { make_errata(reflection_errata(), "errata-reflection", out); }}};
}

}  // namespace shlight
