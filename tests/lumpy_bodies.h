// Closed irregular bodies: spheres with bumps and dents, flattened or not.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "shapes.h"

namespace raytube::shapes {

/// One about a direction, of `height` beside the radius of the body and e^{-sharpness (1 - cos)} wide.
struct Bump {
  dvec3 direction;
  double height, sharpness;
};

/// A star-shaped body about the origin, its points those of an icosphere, `reach` [m] from the origin at most.
inline PolygonSoup lumpy_body(int subdivisions, const std::vector<Bump>& bumps, const dvec3& stretch, double reach) {
  PolygonSoup soup = icosphere(subdivisions);
  double farthest = 0.0;
  for (dvec3& p : soup.points) {
    double radius = 1.0;
    for (const Bump& bump : bumps) radius += bump.height * std::exp(bump.sharpness * (glm::dot(p, bump.direction) - 1.0));
    p *= std::clamp(radius, 0.2, 5.0) * stretch;
    farthest = std::max(farthest, glm::length(p));
  }
  for (dvec3& p : soup.points) p *= reach / farthest;
  return soup;
}

/// One of 320 to 5120 triangles with limbs and dents, every third flat, by a seed.
inline PolygonSoup lumpy_body(unsigned seed, int subdivisions, double reach) {
  std::mt19937 bits(seed);
  // The library's distributions are not the same everywhere.
  const auto number = [&](double low, double high) { return low + (high - low) * static_cast<double>(bits()) / 4294967296.0; };
  const auto direction = [&] {
    const double z = number(-1.0, 1.0), phi = number(0.0, 2 * pi), r = std::sqrt(1.0 - z * z);
    return dvec3(r * std::cos(phi), r * std::sin(phi), z);
  };
  std::vector<Bump> bumps(3 + bits() % 8);
  for (Bump& bump : bumps) bump = {direction(), number(-0.6, 2.0), number(1.0, 40.0)};
  const double flatness = seed % 3 == 0 ? number(0.05, 0.3) : number(0.5, 1.0);
  return lumpy_body(subdivisions, bumps, {flatness, 1.0, number(0.4, 1.0)}, reach);
}

}  // namespace raytube::shapes
