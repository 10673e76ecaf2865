#pragma once

#include <optional>
#include <string>
#include <vector>

// Where the thesis's print is wrong, each with a number that shows it. Not installed.

namespace shlight {

struct Erratum {
  std::string id;
  std::string chapter;                  // of the thesis
  std::string printed, corrected;       // HTML
  std::string quantity;                 // HTML: what the three values are
  std::optional<double> printed_value;  // by the printed formula; none where it gives no number
  double corrected_value = 0;
  double true_value = 0;    // found without the formula
  std::string truth;        // how
  double tolerance = 1e-6;  // of corrected_value, relative to true_value
  bool at_most = false;     // whether true_value is a bound that must not be passed, rather than a value

  // Whether the corrected formula holds, and the printed one does not.
  bool shown() const;
};

std::vector<Erratum> harmonic_errata();    // chapters 3, 4, 6 and 7
std::vector<Erratum> reflection_errata();  // chapter 8

}  // namespace shlight
