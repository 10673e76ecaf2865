#include "shlight/transfer/bounce.h"

#include <algorithm>
#include <array>

#include "shlight/sh/clones.h"
#include "shlight/sh/coefficients.h"

namespace shlight {
namespace {

constexpr std::size_t kStreamRays = 1 << 15;

// sums += Σ_k weights[k] · row k, for each of three channels times its factor; n values a channel.
SHLIGHT_CLONES void add_reflected(const float* row0, const float* row1, const float* row2, const float* weights,
                                  const float* factors, std::size_t n, float* sums) {
  for (std::size_t c = 0; c < 3; ++c) {
    const float w0 = factors[c] * weights[0], w1 = factors[c] * weights[1], w2 = factors[c] * weights[2];
    const float *a = row0 + c * n, *b = row1 + c * n, *d = row2 + c * n;
    float* s = sums + c * n;
    for (std::size_t i = 0; i < n; ++i) s[i] += w0 * a[i] + w1 * b[i] + w2 * d[i];
  }
}

// Some occluded samples of one site.
struct Part {
  std::size_t site = 0;  // of the batch
  OccludedSamples occluded;
};

void gather_parts(const BounceSource& source, std::span<const Part> parts, std::span<const RaySegment> segments,
                  std::span<double> sums, BounceWorkspace& w) {
  w.stream.fill(source.plan.samples, segments);
  const std::span<const Ray> rays = w.stream.rays();
  w.sorted_hits.resize(rays.size()), w.hits.resize(rays.size()), w.directions.resize(rays.size());
  source.tracer.find_hits(rays, w.sorted_hits);
  for (std::size_t j = 0; j < rays.size(); ++j) {
    w.hits[rays[j].id] = w.sorted_hits[j];
    w.directions[rays[j].id] = rays[j].direction;
  }

  const std::size_t n = static_cast<std::size_t>(num_coefficients(source.plan.samples.bands));
  std::vector<float> run(3 * n);
  std::size_t j = 0;
  for (const Part& part : parts) {
    std::ranges::fill(run, 0.0f);
    for (std::size_t k = 0; k < part.occluded.samples.size(); ++k, ++j) {
      if (w.hits[j].triangle == Hit::kNone) continue;
      const auto point = source.surfaces.meet(w.hits[j], w.directions[j]);
      if (!point) continue;
      std::array<const float*, 3> rows;
      for (std::size_t corner = 0; corner < 3; ++corner)
        rows[corner] = source.transfer.data() + 3 * n * source.sites.of_vertex[point->vertices[corner]];
      const Vec3f reflected = part.occluded.weights[k] * point->reflectance;
      const float factors[3] = {reflected.x, reflected.y, reflected.z};
      add_reflected(rows[0], rows[1], rows[2], point->weights.data(), factors, n, run.data());
    }
    for (std::size_t i = 0; i < 3 * n; ++i) sums[3 * n * part.site + i] += double{run[i]};
  }
}

}  // namespace

std::size_t gather_bounce(const BounceSource& source, std::size_t begin, std::size_t end,
                          std::span<const std::uint8_t> packed, std::span<float> result, BounceWorkspace& w) {
  const std::size_t n = static_cast<std::size_t>(num_coefficients(source.plan.samples.bands));
  std::vector<double> sums(3 * n * (end - begin));
  std::vector<Part> parts;
  std::vector<RaySegment> segments;
  std::size_t rays = 0, total = 0;
  const auto flush = [&] {
    // Segments look into their parts, which have stopped moving only now.
    for (std::size_t k = 0; k < parts.size(); ++k) segments[k].samples = parts[k].occluded.samples;
    gather_parts(source, parts, segments, sums, w);
    parts.clear(), segments.clear();
    total += rays;
    rays = 0;
  };
  for (std::size_t site = begin; site < end; ++site) {
    unpack_occlusion(source.plan, packed, w.occlusion);
    const SiteSamples s = make_site_samples(source.plan, site, source.sites.normals[site], source.seed);
    const OccludedSamples occluded = occluded_samples(source.plan, w.occlusion);
    // Floats hold a few hundred hits without a loss that would show; longer sums go on in double.
    constexpr std::size_t kRun = 256;
    for (std::size_t first = 0; first < occluded.samples.size(); first += kRun) {
      const std::size_t count = std::min(kRun, occluded.samples.size() - first);
      const auto from = static_cast<std::ptrdiff_t>(first), to = static_cast<std::ptrdiff_t>(first + count);
      parts.push_back({site - begin,
                       {{occluded.samples.begin() + from, occluded.samples.begin() + to},
                        {occluded.weights.begin() + from, occluded.weights.begin() + to}}});
      segments.push_back({source.sites.origins[site], s.frame, s.set, {}});
      rays += count;
      if (rays >= kStreamRays) flush();
    }
  }
  if (rays > 0) flush();
  std::ranges::transform(sums, result.begin(), [](double v) { return static_cast<float>(v); });
  return total;
}

}  // namespace shlight
