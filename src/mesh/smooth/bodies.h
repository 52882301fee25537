// The curved bodies of a set.
#pragma once

#include <optional>

#include "mesh/model/face_tree.h"
#include "mesh/smooth/smooth.h"

namespace raytube {

/// How deep a facet may seem to lie below its neighbours on a convex surface, in rises of that over its facets: normals at
/// vertices are means of few facets, wrong by up to what the surface turns over one of them.
inline constexpr double most_dent = 4.0;

/// The surfaces of those closed components which are convex but for the dents between their facets and stand apart: all else is
/// further from their outside than they reach from their middle. There what they reflect has widened to three times and more in
/// each curved plane, 1 + 2 d / R at a distance d from a radius R, which the parallel tubes of facets do not; and little of it
/// meets anything. Other surfaces count as flat. Nothing if there is no such body. Creases below `max_crease` [rad] are
/// tessellation.
std::optional<SmoothSurfaces> bodies_apart(const FaceTree& faces, double max_crease);

}  // namespace raytube
