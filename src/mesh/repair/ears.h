// Triangles off a polygon, ear by ear.
#pragma once

#include "mesh/repair/planar_ring.h"

namespace raytube {

/// Cuts ears one by one. A corner can be cut off when it is convex and no other corner lies in the triangle; those that the ring
/// passes twice (the bridge to a hole) are the triangle's own and do not count. The next ear is looked for from the second corner
/// after the last one: ears all round, not one long fan of slivers. A ring without an ear (it crosses itself, or is a line) loses
/// its next corner all the same, so that every polygon yields its full number of triangles.
std::vector<Triangle> cut_ears(const PlanarRing& plane, const Ring& ring);

}  // namespace raytube
