#pragma once

#include <string>

#include "shlight/truth/band_error.h"

namespace shlight {

struct BandPlotParams {
  std::string title;
  std::string measure;   // what the tolerance is about, a name of band_measures()
  double tolerance = 0;  // a line across, above 0
  std::string windowed;  // what is said of the errors with a window, where there are any
};

// The errors over the number of bands, and below it the share of the energy in each band, both on logarithmic axes: an
// SVG picture that is legible on light and dark pages, with the title and everything that its curves mean in words.
std::string make_band_plot(const BandErrors& errors, const BandPlotParams& params);

}  // namespace shlight
