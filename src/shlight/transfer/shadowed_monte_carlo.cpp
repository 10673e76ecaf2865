#include "shlight/transfer/shadowed_monte_carlo.h"

#include <limits>
#include <vector>

namespace shlight {

std::size_t sample_shadowed_transfer(const Tracer& tracer, const Sites& sites, std::size_t begin, std::size_t end,
                                     const SphereSamples& samples, std::span<float> coefficients) {
  std::vector<Ray> rays;
  std::vector<double> sums;
  std::size_t total = 0;
  for (std::size_t site = begin; site < end; ++site) {
    rays.clear();
    for (std::size_t j = 0; j < samples.directions.size(); ++j) {
      if (dot(samples.directions[j], vec_cast<double>(sites.normals[site])) <= 0) continue;
      Ray ray;
      ray.origin = sites.origins[site];
      ray.direction = vec_cast<float>(samples.directions[j]);
      ray.far = std::numeric_limits<float>::infinity();
      ray.id = static_cast<std::uint32_t>(j);
      rays.push_back(ray);
    }
    tracer.find_occluded(rays);
    total += rays.size();

    const std::size_t n = samples.basis_of(0).size();
    sums.assign(n, 0.0);
    for (const Ray& ray : rays) {
      if (ray.far < 0) continue;
      const double cosine = dot(samples.directions[ray.id], vec_cast<double>(sites.normals[site]));
      for (std::size_t i = 0; i < n; ++i) sums[i] += cosine * samples.basis_of(ray.id)[i];
    }
    const double weight = 4 / static_cast<double>(samples.directions.size());
    for (std::size_t i = 0; i < n; ++i) coefficients[n * (site - begin) + i] = static_cast<float>(weight * sums[i]);
  }
  return total;
}

}  // namespace shlight
