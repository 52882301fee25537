// Sectors of free space around the edges of a mesh, and their straight runs.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

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
struct EdgeSector {
  std::array<PatchSide, 2> faces;
  std::uint32_t start = 0, end = 0;  // vertices
  double n = 0.0;                    // angle / pi
};

/// The sectors between neighbouring triangles around each edge whose two sides are exposed: both sides of open components,
/// the front of closed ones. Ordered by edge; faces[0] <= faces[1]. Only the sectors that `takes` are listed.
std::vector<EdgeSector> exposed_sectors(const TriangleMesh& mesh, const std::function<bool(const EdgeSector&)>& takes);

/// False where two faces lie on one another: what lies between them is rounding, no space.
bool has_opening(const EdgeSector& sector);

/// True if the faces of the sector, of one edge, differ from a plane by at least `min_wedge_angle` [rad], and the edge is no
/// bend.
bool is_wedge(const TriangleMesh& mesh, const EdgeSector& sector, double min_wedge_angle);

/// Joins sectors with the same faces that follow one another on a straight line, within `distance` [m]. A run stands where its
/// first sector stood.
std::vector<EdgeSector> join_straight(std::span<const dvec3> vertices, std::vector<EdgeSector> sectors, double distance);

/// Unit vectors of a face at an edge: into the face, across the edge; and the normal out of this side, turned perpendicular to
/// the edge.
struct FaceFrame {
  dvec3 into_face;
  dvec3 normal;
};

/// The frame of faces[0] (`index` 0) or faces[1] of a sector about `tangent`, a unit vector; `outward` points out of its side.
FaceFrame face_frame(const dvec3& outward, const dvec3& tangent, int index);
FaceFrame face_frame(const TriangleMesh& mesh, const PatchSide& side, const dvec3& tangent, int index);

/// Angle from faces[0] to faces[1] counter-clockwise, 0 ... 2 pi [rad].
double opening(const FaceFrame& first, const FaceFrame& second);

/// That angle over pi, when it is known to be about `n`: angles just above 0 and just below 2 pi differ by rounding only.
double refined_n(const FaceFrame& first, const FaceFrame& second, double n);

}  // namespace raytube
