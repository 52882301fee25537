// How much a lit piece of an edge and a face that it illuminates can scatter at most. Derived in docs/theory/interaction.md.
#pragma once

#include <vector>

#include "utd/interaction/edge_illumination.h"

namespace raytube {

/// Where a patch is: its box [m], and its area [m^2].
struct PatchExtent {
  dvec3 low, high;
  double area = 0.0;
  bool closed = false;  // of a closed body: met from outside only
};

/// Of all patches of a mesh.
std::vector<PatchExtent> patch_extents(const TriangleMesh& mesh);

struct PairBound {
  double amplitude = 0.0;           // |S_pq| is no larger [m]; 0: the waves never meet the face first
  AzimuthRange azimuths{0.0, 0.0};  // about the edge, between which the face lies
};

/// Bound of what the waves of `source` excite on a face that they meet first, and after up to `reflections` reflections by it, at
/// the wavenumber k [rad/m].
PairBound pair_bound(const LitEdgePiece& source, const Patch& plane, const PatchExtent& face, double k, int reflections);

/// Bound of |S_pq| of the fringe current of a lit piece of an edge, of any length [m].
double fringe_bound(const LitEdgePiece& source);

}  // namespace raytube
