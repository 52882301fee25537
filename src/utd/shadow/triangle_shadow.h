// The shadow that one triangle throws on a line of points.
#pragma once

#include <array>

#include "mesh/model/triangle_mesh.h"
#include "utd/shadow/viewpoint.h"

namespace raytube {

/// Which points of a straight line, as fractions of the way from its start to its end, lie behind one triangle as seen from a
/// viewpoint. A point does where a few functions that are linear along the line are all above zero: the volumes spanned by each
/// side of the triangle and the point's ray, and the height of the triangle's plane over the point.
class TriangleShadow {
 public:
  TriangleShadow(const TriangleMesh& mesh, std::uint32_t triangle, const dvec3& start, const dvec3& end, const Viewpoint& view);

  /// True if it hides this point by more than rounding.
  bool hides(double fraction) const;

  /// The point at which the shadow ends, going from `hidden` within it towards `other`; as far as infinity.
  double end_towards(double other, double hidden) const;

 private:
  struct Linear {
    double at_start = 0.0, at_end = 0.0, rounding = 0.0;
    double at(double fraction) const { return at_start + fraction * (at_end - at_start); }
  };
  std::array<Linear, 4> above_zero_;  // all of them in the shadow; none is if the triangle is seen edge-on
};

}  // namespace raytube
