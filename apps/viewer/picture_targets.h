#pragma once

#include <memory>
#include <vector>

#include "gl_thread.h"
#include "shlight/render/targets.h"

namespace shlight::viewer {

// What pictures for the window are drawn into: who shows one keeps it, and it is not drawn into until it is let go.
// On the GlThread only.
class PictureTargets {
 public:
  explicit PictureTargets(GlThread& thread) : thread_(thread) {}

  // One of this size that nobody shows; those of other sizes that nobody shows are deleted.
  std::shared_ptr<PictureTarget> free_one(int width, int height);

 private:
  GlThread& thread_;
  std::vector<std::shared_ptr<PictureTarget>> targets_;
};

}  // namespace shlight::viewer
