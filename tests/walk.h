// A walk of rays inside a closed mesh, to count leaks.
#pragma once

#include <algorithm>
#include <random>

#include "mesh/model/geometry.h"
#include "mesh/trace/tracer.h"
#include "scene/material.h"

namespace raytube::testing {

/// A ray from a random point of a random facet into the body. The plane of a sliver may be far from that of its patch: what leads
/// into the body by only one of them is no such ray.
inline Ray ray_into(const TriangleMesh& mesh, std::mt19937_64& generator) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto triangle = static_cast<std::uint32_t>(generator() % mesh.triangles.size());
  const auto& [i, j, k] = mesh.triangles[triangle];
  const double a = std::sqrt(uniform(generator)), b = uniform(generator);
  const dvec3 point = (1.0 - a) * mesh.vertices[i] + a * (1.0 - b) * mesh.vertices[j] + a * b * mesh.vertices[k];
  const std::uint32_t patch = mesh.triangle_patch[triangle];
  const double z = 2.0 * uniform(generator) - 1.0, phi = 2.0 * pi * uniform(generator), s = std::sqrt(1.0 - z * z);
  const dvec3 direction(s * std::cos(phi), s * std::sin(phi), z);
  const dvec3 into = glm::dot(direction, mesh.patches[patch].normal) < 0.0 ? direction : -direction;
  if (glm::dot(into, area_vector(mesh.vertices, mesh.triangles[triangle])) >= 0.0) return ray_into(mesh, generator);
  return {point, into, patch};
}

/// True if a ray inside a closed mesh met nothing, or the outside of a facet.
inline bool is_lost(const TriangleMesh& mesh, const Ray& ray, const Hit& hit) {
  return !hit || glm::dot(mesh.patch_of(hit.triangle).normal, ray.direction) < 0.0;
}

/// Shoots `count` rays, each reflected where the one before ended; returns how many were lost.
inline std::uint64_t lost_inside(const Tracer& tracer, std::uint64_t count, std::uint64_t seed) {
  const TriangleMesh& mesh = tracer.mesh();
  std::mt19937_64 generator(seed);
  std::vector<Ray> rays(1024);
  std::ranges::generate(rays, [&] { return ray_into(mesh, generator); });
  std::vector<Hit> hits(rays.size());
  std::uint64_t lost = 0;
  for (std::uint64_t shot = 0; shot < count; shot += rays.size()) {
    tracer.closest_hits(rays, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (is_lost(mesh, rays[i], hits[i])) {
        ++lost;
        rays[i] = ray_into(mesh, generator);
        continue;
      }
      const std::uint32_t patch = mesh.triangle_patch[hits[i].triangle];
      const dvec3 point = rays[i].origin + hits[i].distance * rays[i].direction;
      rays[i] = {point, glm::normalize(reflected_direction(rays[i].direction, mesh.patches[patch].normal)), patch};
    }
  }
  return lost;
}

inline std::uint64_t lost_inside(const TriangleMesh& mesh, std::uint64_t count, std::uint64_t seed) {
  return lost_inside(Tracer(mesh), count, seed);
}

}  // namespace raytube::testing
