#include <fmt/format.h>

#include <utility>

#include "shlight/transfer/transfer.h"

namespace shlight {

std::string to_text(const BakeStatus& status) {
  std::string text = fmt::format("{:.0f} %", 100 * status.fraction_done);
  if (status.rays_per_second > 0) text += fmt::format(", {:.1f} million rays/s", 1e-6 * status.rays_per_second);
  if (status.seconds_left < 0) return text;
  if (status.seconds_left < 100) return text + fmt::format(", {:.0f} s left", status.seconds_left);
  return text + fmt::format(", {:.0f} min left", status.seconds_left / 60);
}

BakeWatcher watch(Progress progress) {
  if (!progress) return {};
  return [progress = std::move(progress)](const BakeStatus& status) { return progress(status.fraction_done); };
}

}  // namespace shlight
