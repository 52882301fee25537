// How much a lit piece of an edge and a face that it illuminates can scatter at most. Derived in docs/theory/interaction.md.
#pragma once

#include <vector>

#include "utd/interaction/edge_illumination.h"

namespace raytube {

/// Where a patch is: no box along the axes, which would hang on how the mesh is turned.
struct PatchExtent {
  std::vector<dvec3> outline;  // corners of its convex hull [m]
  dvec3 centroid{0.0};         // [m]
  double area = 0.0;           // [m^2]
  bool closed = false;         // of a closed body: met from outside only
};

/// Of all patches of a mesh.
std::vector<PatchExtent> patch_extents(const TriangleMesh& mesh);
/// Their areas alone [m^2].
std::vector<double> patch_areas(const TriangleMesh& mesh);

struct PairBound {
  double amplitude = 0.0;           // |S_pq| is no larger [m]; 0: the waves never meet the face first
  double expected = 0.0;            // as large as it is where phases cancel as they do on most faces [m]; no bound
  AzimuthRange azimuths{0.0, 0.0};  // about the edge, between which the face lies
};

/// Where a bound is asked for.
struct PairView {
  double wavenumber;  // [rad/m]
  dvec3 scattered;    // unit, towards the receiver
};

/// Bound of what the waves of `source` excite on a face that they meet first, and after up to `reflections` reflections by it.
PairBound pair_bound(const LitEdgePiece& source, const Patch& plane, const PatchExtent& face, const PairView& view,
                     int reflections);

/// Bound of |S_pq| of the fringe current of a lit piece of an edge, of any length [m].
double fringe_bound(const LitEdgePiece& source);

}  // namespace raytube
