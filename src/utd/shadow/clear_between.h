// Whether everything between two edges is free space, told once for all rays from one to the other.
#pragma once

#include "mesh/features/wedges.h"
#include "mesh/model/face_tree.h"

namespace raytube {

/// True if no face but those of the two wedges can stand between any point within one edge and any point within the other: each
/// lies on one side of a plane, its own or that of a face of either wedge, and both edges, not both within the plane, on the
/// other side. Where it is false another plane may part them. Thread-safe.
bool is_clear_between(const FaceTree& faces, const Wedge& one, const Wedge& other);

}  // namespace raytube
