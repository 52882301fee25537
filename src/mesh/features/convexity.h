// Whether the surfaces of a target can light or shadow one another at all.
#pragma once

#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// What the shape of a target rules out.
struct Convexity {
  bool no_reflection = false;  // what one face reflects meets no other: a convex body, or a plate
  bool no_shadow = false;      // every face turned to the source is lit as a whole: a convex body
};

/// Tells a single convex body, or faces that all lie in one plane, by their corners, to rounding. Everything else has neither.
Convexity find_convexity(const TriangleMesh& mesh);

/// Whether a closed connected surface bounds a convex body but for dents, as facets of a convex surface leave them: from no
/// vertex does the mesh, uphill, rise by more than `dent` [m] above the plane that touches it there across the mean normal.
bool convex_up_to(const TriangleMesh& mesh, double dent);

}  // namespace raytube
