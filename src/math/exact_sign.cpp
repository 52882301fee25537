#include "math/exact_sign.h"

#include <CGAL/Mpzf.h>

namespace raytube {

int exact_side(const dvec3& direction, const dvec3& origin, const dvec3& a, const dvec3& b) {
  using Exact = CGAL::Mpzf;
  Exact to_a[3], to_b[3];
  for (int axis = 0; axis < 3; ++axis) {
    to_a[axis] = Exact(a[axis]) - Exact(origin[axis]);
    to_b[axis] = Exact(b[axis]) - Exact(origin[axis]);
  }
  Exact volume = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    volume = volume + Exact(direction[axis]) * (to_a[next] * to_b[last] - to_a[last] * to_b[next]);
  }
  return CGAL::sign(volume);
}

}  // namespace raytube
