// Flat tips: points of curved bodies in which two narrow rims meet.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "utd/surface/curved_target.h"
#include "utd/tip/rim_line.h"

namespace raytube {

/// Where a rim comes to: a tip again.
struct RimEnd {
  std::uint32_t tip, rim;
  double length;  // length of the rim from tip to tip [m]
};

struct Rim {
  std::vector<RimPlace> places;  // from its tip on
  double curvature = 0.0;        // mean over its first quarter [1/m]
  std::optional<RimEnd> end;
};

/// Next to it the body is a thin sector of a plane, with the rims for its edges.
struct FlatTip {
  dvec3 position, bisector, normal;  // the bisector runs into the body
  double angle;                      // between the rims [rad]
  std::array<Rim, 2> rims;

  /// From the bisector towards a rim.
  dvec3 across(std::uint32_t rim) const { return (rim == 0 ? 1.0 : -1.0) * glm::cross(normal, bisector); }
};

/// Flat tips in the order of their vertices. Their rims are those of the target's rounded edges (utd/surface/noses) at
/// `wavelength`, in steps of a part of it.
std::vector<FlatTip> find_flat_tips(const CurvedTarget& target, double wavelength);

}  // namespace raytube
