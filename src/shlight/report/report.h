#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "shlight/light/light.h"

// The thesis, reproduced: its figures, tables and claims, and where its print is wrong, remade on this machine and
// measured against references that it did not have, as one page.
//
// [1] Baćić 2010, Model distribucije reflektiranog svjetla, FER Zagreb.

namespace shlight {

struct ReportParams {
  std::string light = "builtin:studio";  // as load_light takes it: of figures, of table 1 and of claims
  LoadLightParams load;
  std::vector<std::string> models;  // as make_scene takes them: the first is the scene of figures 17 to 22, and each
                                    // has rows of its own in tables 2 and 4; empty: built-in ones only
  int samples = 10000;  // of the thesis's Monte Carlo methods, 9 … kMaxTransferSamples; the next square number is taken
  bool quick = false;  // smaller pictures, noisier references, fewer sizes, lights, bands and frames
};

// A number that a part has measured.
struct ReportValue {
  std::string name;
  double value = 0;
  bool is_time = false;  // seconds or what follows from them, which differs from run to run; nothing else does
};

// A figure, table, claim, or the list of errata.
struct ReportPart {
  std::string id, title;  // "table-2", "Table 2: …"
  std::vector<ReportValue> values;
  std::vector<std::filesystem::path> files;  // the pictures, plots and tables behind it
  std::string missing;                       // why it is not there; empty: it is
  double seconds = 0;
};

struct Report {
  std::filesystem::path page;
  std::string processor;  // "… , 2 cores"
  std::vector<ReportPart> parts;

  std::vector<const ReportPart*> missing() const;
};

// Called from one thread at a time with the part that is being made and how much of the report is done, in [0, 1],
// never decreasing; returning false stops it.
using ReportWatcher = std::function<bool(const std::string& part, double fraction_done)>;

// Makes the report in `folder`, which is made where it is missing: thesis.html, with all pictures inside, and the files
// behind each part. A part that fails leaves the others: the page says what is missing and why. Throws Error where the
// page cannot be written, before anything is made; Cancelled, after the page of what is finished.
Report reproduce_thesis(const std::filesystem::path& folder, const ReportParams& params,
                        const ReportWatcher& watcher = {});

}  // namespace shlight
