// Where a wave leaves curved surfaces in the dark.
#pragma once

#include <vector>

#include "utd/surface/curved_target.h"
#include "utd/surface/local_look.h"
#include "utd/surface/surface_ray.h"

namespace raytube {

/// A piece of a shadow boundary.
struct BoundaryPiece {
  FacetPoint middle;  // half way along it
  dvec3 chord;        // from its one end to the other [m]
};

/// The lines on which the normals, linear over the facets, are across the wave, each in equal pieces of at most `widest` [m] over
/// which the normal turns by at most `most_turn` [rad]; closed ones stretch by stretch, from one coordinate plane through their
/// centroid to the next. So pieces hang on where lines run alone, and bodies mirrored in a coordinate plane have mirrored pieces.
std::vector<BoundaryPiece> shadow_boundary(const CurvedTarget& target, const LocalLook& look, double widest, double most_turn);

}  // namespace raytube
