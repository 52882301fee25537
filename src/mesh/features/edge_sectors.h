// Free sectors around the mesh's edges, and their straight runs.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/model/edge_table.h"
#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// One side of a patch: its front, where the normal points, or its back.
struct PatchSide {
  std::uint32_t patch = no_index;
  bool back = false;
  friend auto operator<=>(const PatchSide&, const PatchSide&) = default;
};

/// A sector of free space at a mesh edge, or along a run of them: it opens counter-clockwise about start -> end, from faces[0]
/// to faces[1].
struct EdgePiece {
  std::array<PatchSide, 2> faces;
  std::uint32_t start = 0, end = 0;  // vertices
  double n = 0.0;                    // angle / pi
};

/// The sectors between neighbouring triangles around each edge whose two sides are exposed: both sides of open components,
/// the front of closed ones. Ordered by edge; faces[0] <= faces[1].
std::vector<EdgePiece> exposed_sectors(const TriangleMesh& mesh, const EdgeTable& edges);

/// False where two faces touch: what lies between them is rounding, no space.
bool has_opening(const EdgePiece& piece);

/// True if the piece's faces differ from a plane by at least `min_wedge_angle` [rad].
bool is_wedge(const TriangleMesh& mesh, const EdgePiece& piece, double min_wedge_angle);

/// Joins pieces with the same faces that follow one another on a straight line, within `distance`. A run takes the place of
/// its first piece.
std::vector<EdgePiece> join_straight(std::span<const dvec3> vertices, std::vector<EdgePiece> pieces, double distance);

/// The face's normal, as seen from this side, turned perpendicular to the edge; and the direction into the face for
/// faces[0] (`index` 0) or faces[1] of a sector about `tangent`.
struct FaceFrame {
  dvec3 into_face;
  dvec3 normal;
};
FaceFrame face_frame(const TriangleMesh& mesh, const PatchSide& side, const dvec3& tangent, int index);

/// Angle from faces[0] to faces[1] counter-clockwise, 0 ... 2 pi.
double opening(const FaceFrame& first, const FaceFrame& second);

/// The same over pi, when about `n` is known: angles just above 0 and just below 2 pi differ by rounding only.
double refined_n(const FaceFrame& first, const FaceFrame& second, double n);

}  // namespace raytube
