// Waves over curved surfaces that reach a wedge.
#pragma once

#include <array>
#include <vector>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// A strip that ends where its surface does.
struct SurfaceArrival {
  std::uint32_t triangle;  // it ends on the side from `corner` of this one to the next
  int corner;
  bool back;  // on the side of the facet that its normal points away from
  dvec3 position, direction;
  dvec3 start;  // where it began
  double path;  // exponent / k of what radiates from its end, but for slow changes [m]
  /// Per frequency of the look and transmit polarisation: half the current along the strip, times its width [m] and the phase of
  /// what radiates from there.
  std::vector<std::array<Complex, 2>> magnetic;
};

}  // namespace raytube
