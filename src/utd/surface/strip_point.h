// A point of a curved surface with the frame of a strip that runs over it.
#pragma once

#include "utd/surface/curved_target.h"
#include "utd/surface/surface_ray.h"

namespace raytube {

struct StripPoint {
  dvec3 position, normal, along, binormal;  // t, b = t x n
  double curvature;                         // normal, along the strip [1/m]

  /// Of two fields, transmit V and H, the parts along the binormal.
  std::array<double, 2> across(const std::array<dvec3, 2>& fields) const {
    return {glm::dot(fields[0], binormal), glm::dot(fields[1], binormal)};
  }
};

/// At a point of a facet for a strip that goes in that direction; `side` as for CurvedTarget::frame.
inline StripPoint strip_point(const CurvedTarget& target, const FacetPoint& p, const dvec3& walking, double side) {
  const SurfaceFrame frame = target.frame(p.triangle, p.l, side);
  const dvec3 along = glm::normalize(walking - glm::dot(walking, frame.normal) * frame.normal);
  return {target.surfaces.facet(p.triangle).point(p.l), frame.normal, along, glm::cross(along, frame.normal),
          frame.curvature(along)};
}

}  // namespace raytube
