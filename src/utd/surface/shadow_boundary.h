// Where a wave leaves curved surfaces in the dark.
#pragma once

#include <vector>

#include "utd/surface/curved_target.h"
#include "utd/surface/surface_ray.h"
#include "utd/wedge/edge_currents.h"

namespace raytube {

/// A piece of a shadow boundary.
struct BoundaryPiece {
  FacetPoint middle;  // half way along it
  dvec3 chord;        // from its one end to the other [m]
};

/// The lines on which the normals, linear over the facets, are across the wave, each in equal pieces of at most `widest` [m] over
/// which the normal turns by at most `most_turn` [rad]. Closed lines are divided from where they are foremost along the look, so
/// that pieces hang neither on the order of triangles nor on axes.
std::vector<BoundaryPiece> shadow_boundary(const CurvedTarget& target, const LookVectors& look, double widest, double most_turn);

}  // namespace raytube
