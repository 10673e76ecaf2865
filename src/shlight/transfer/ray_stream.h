#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shlight/transfer/hemisphere_samples.h"
#include "shlight/transfer/local_frame.h"
#include "shlight/transfer/tracer.h"

namespace shlight {

// Some samples of one site: what a stream of rays is made of.
struct RaySegment {
  Vec3f origin;
  LocalFrame frame;
  std::size_t set = 0;
  std::span<const std::uint32_t> samples;  // their numbers in the set
};

// Many rays of neighbouring sites, sorted by direction: those that stand beside each other begin near each other and go
// nearly the same way, which is what makes tracers quick. Kept and filled again, since its memory is worth keeping.
class RayStream {
 public:
  // Numbers rays from 0: the segments' samples, one segment after the other.
  void fill(const HemisphereSamples& samples, std::span<const RaySegment> segments);
  std::span<Ray> rays() { return rays_; }

 private:
  std::vector<float> x_, y_, z_;
  std::vector<std::uint16_t> bins_;
  std::vector<std::uint32_t> next_;
  std::vector<Ray> rays_;
};

}  // namespace shlight
