// Lines along rounded edges.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "utd/surface/noses.h"

namespace raytube {

/// A place on a rim that comes to a tip.
struct RimPlace {
  dvec3 position;
  dvec3 tangent;           // towards the tip
  dvec3 outwards;          // normal of the body there
  double distance = 0.0;   // from the tip along the rim [m]
  double begin = 0.0;      // distance at which the stretch begins that it stands for [m]
  double step = 0.0;       // length of that stretch [m]
  double radius = 0.0;     // radius of the section across the rim [m]
  double curvature = 0.0;  // curvature of the rim along itself [1/m]
  double bend = 0.0;       // INT (curvature^2 / 2)^(1/3) ds from the tip [m^(1/3)]: xi over k^(1/3)
};

/// Follows rims from tips over the noses of facets.
class RimTracer {
 public:
  /// Keeps a reference to the noses.
  RimTracer(std::span<const Nose> noses, double wavelength) : noses_(noses), wavelength_(wavelength) {}

  /// Directions in which rims may leave a tip: to the nearest nose whose edge points to it, and to the nearest ones on other
  /// lines.
  std::vector<dvec3> directions_from(const dvec3& tip) const;
  /// From the tip until no nose is near, or the rim comes back to the tip; empty if there is none.
  std::vector<RimPlace> trace(const dvec3& tip, const dvec3& direction) const;

 private:
  RimPlace mean_ahead(const dvec3& at, const dvec3& ahead, double farthest, double jitter) const;
  std::optional<RimPlace> next(const dvec3& at, const dvec3& ahead, double jitter) const;

  std::span<const Nose> noses_;
  double wavelength_;
};

}  // namespace raytube
