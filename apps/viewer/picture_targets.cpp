#include "picture_targets.h"

namespace shlight::viewer {

std::shared_ptr<PictureTarget> PictureTargets::free_one(int width, int height) {
  const auto fits = [&](const auto& target) { return target->width() == width && target->height() == height; };
  std::erase_if(targets_, [&](const auto& target) { return target.use_count() == 1 && !fits(target); });
  for (const auto& target : targets_)
    if (target.use_count() == 1) return target;
  return targets_.emplace_back(thread_.own(std::make_unique<PictureTarget>(width, height)));
}

}  // namespace shlight::viewer
