#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "shlight/sh/vec.h"

namespace shlight {

// origin + t · direction for near <= t <= far, laid out as ray tracers have it, so that many rays are handed over as
// they lie.
struct alignas(16) Ray {
  Vec3f origin;
  float near = 0;
  Vec3f direction;  // of unit length
  float time = 0;   // nothing moves
  float far = 0;    // negative once the ray is found occluded
  std::uint32_t mask = ~0u;
  std::uint32_t id = 0;  // the caller's
  std::uint32_t flags = 0;
};

// What a ray meets first: the point (1 − u − v) p0 + u p1 + v p2 of a triangle.
struct Hit {
  static constexpr std::uint32_t kNone = ~0u;
  std::uint32_t triangle = kNone;
  float u = 0, v = 0;
};

// Answers what rays meet. All that the baker asks of a ray tracer; called from many threads at once. The same rays must
// get the same answers whenever they are asked and whoever stands beside them in the span: what a bake promises about
// equal bits rests on it.
class Tracer {
 public:
  virtual ~Tracer() = default;
  // Sets `far` of each ray that meets anything to a negative value, and leaves the others as they are.
  virtual void find_occluded(std::span<Ray> rays) const = 0;
  // Writes what each ray meets first; as many hits as rays.
  virtual void find_hits(std::span<const Ray> rays, std::span<Hit> hits) const = 0;
};

// Makes a tracer of triangles, three indices each, which both sides of stop rays. Triangles without area are met by
// none. The spans outlive the tracer.
using MakeTracer =
    std::function<std::unique_ptr<Tracer>(std::span<const Vec3f> positions, std::span<const std::uint32_t> indices)>;

// The tracer that is used where nobody brings another: Embree's. Takes about 200 bytes a triangle. Huge fans of thin
// triangles are thinned out as far as the rounding of coordinates lets (merge_fans.h). Throws Error.
std::unique_ptr<Tracer> make_embree_tracer(std::span<const Vec3f> positions, std::span<const std::uint32_t> indices);

}  // namespace shlight
