// Rays for the tests of the tracer.
#pragma once

#include <cmath>
#include <random>

#include "mesh/trace/tracer.h"

namespace raytube {

/// Rays that single precision is likely to mistake: through points beside edges by 1e-16 to 1e-5 of the radius, many of them
/// almost in the plane of a triangle there.
class UncertainRays {
 public:
  explicit UncertainRays(const TriangleMesh& mesh) : mesh_(mesh) {}

  Ray next() {
    const auto& corners = mesh_.triangles[pick(mesh_.triangles.size())];
    const std::uint32_t side = pick(3);
    const dvec3 from = mesh_.vertices[corners[side]], to = mesh_.vertices[corners[(side + 1) % 3]];
    const dvec3 point = from + uniform() * (to - from) + small() * mesh_.radius * direction();
    dvec3 along = direction();
    const dvec3 normal = glm::normalize(glm::cross(to - from, mesh_.vertices[corners[(side + 2) % 3]] - from));
    if (pick(2)) along = glm::normalize(along - glm::dot(along, normal) * normal + 100.0 * small() * normal);
    if (glm::length(glm::cross(along, glm::normalize(to - from))) < 0.01) return next();
    return {point - (0.5 + 2.0 * uniform()) * mesh_.radius * along, along, no_index};
  }

 private:
  std::uint32_t pick(std::size_t count) { return static_cast<std::uint32_t>(generator_() % count); }
  double uniform() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }
  double small() { return std::pow(10.0, -5.0 - 11.0 * uniform()) * (pick(2) ? 1.0 : -1.0); }
  dvec3 direction() {
    const double z = 2.0 * uniform() - 1.0, phi = 2.0 * pi * uniform(), s = std::sqrt(1.0 - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
  }

  const TriangleMesh& mesh_;
  std::mt19937_64 generator_{7};
};

}  // namespace raytube
