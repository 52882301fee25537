// A walk of rays inside a closed mesh, to count leaks.
#pragma once

#include <algorithm>
#include <random>

#include "material.h"
#include "mesh/tracer.h"

namespace raytube::testing {

// Shoots `count` rays, each reflected where the one before ended; returns how many met nothing, or the outside of a facet.
inline std::uint64_t lost_inside(const TriangleMesh& mesh, std::uint64_t count, std::uint64_t seed) {
  const Tracer tracer(mesh);
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto start = [&] {
    const double z = uniform(generator), phi = pi * uniform(generator), s = std::sqrt(1.0 - z * z);
    const dvec3 origin(uniform(generator), uniform(generator), uniform(generator));
    return Ray{0.2 * mesh.radius * origin, {s * std::cos(phi), s * std::sin(phi), z}, no_index};
  };
  std::vector<Ray> rays(1024);
  std::ranges::generate(rays, start);
  std::vector<Hit> hits(rays.size());
  std::uint64_t lost = 0;
  for (std::uint64_t shot = 0; shot < count; shot += rays.size()) {
    tracer.closest_hits(rays, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const std::uint32_t patch = hits[i] ? mesh.triangle_patch[hits[i].triangle] : no_index;
      if (patch == no_index || glm::dot(mesh.patches[patch].normal, rays[i].direction) < 0.0) {
        ++lost;
        rays[i] = start();
        continue;
      }
      const dvec3 point = rays[i].origin + hits[i].distance * rays[i].direction;
      rays[i] = {point, glm::normalize(reflected_direction(rays[i].direction, mesh.patches[patch].normal)), patch};
    }
  }
  return lost;
}

}  // namespace raytube::testing
