// The straight edges that bound each planar face, so that a line drawn on a face can be followed to the point where it leaves it.
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "mesh/features/wedges.h"

namespace raytube {

/// One straight edge of a face's outline. Outer borders and holes are alike: the face lies on the side of `into_face`, and every
/// edge runs with the face on the left as it looks from its exposed side, so that each corner is the start of one edge.
struct OutlineEdge {
  dvec3 start, end;                    // recentred coordinates [m]
  dvec3 into_face;                     // unit, in the face, perpendicular to the edge
  std::uint32_t wedge = no_index;      // the wedge that stands here; no_index if there is none
  std::uint32_t any_wedge = no_index;  // that, or the wedge at which currents of conductors end beside other materials
  int wedge_face = 0;                  // this face is faces[wedge_face] of it
  bool smooth = false;                 // no wedge because the crease is flatter than one: the surface goes on
  dvec3 share{0.0};                    // (end - start) / length^2: from 0 at the start to 1 at the end
  double length = 0.0;                 // [m]

  /// To the edge's line from a point of the face along a direction in it [m].
  double distance(const dvec3& point, const dvec3& direction) const {
    return -glm::dot(point - start, into_face) / glm::dot(direction, into_face);
  }
};

/// Where a line on a face ends.
struct FaceExit {
  const OutlineEdge* edge = nullptr;  // null if the line never leaves, which a closed outline allows by rounding only
  double distance = 0.0;              // [m]
};

/// The outlines of all faces that have a convex wedge; a face is one exposed side of a patch.
class Outlines {
 public:
  Outlines() = default;
  /// `wedges` are those of find_wedges with the same `min_wedge_angle`, or what merge_thin_plate_edges has made of them.
  Outlines(const TriangleMesh& mesh, std::span<const Wedge> wedges, double min_wedge_angle);

  /// The edges of the face that this wedge face belongs to; its own is among them.
  std::span<const OutlineEdge> around(const WedgeFace& face) const;

  /// Where the line from `point` along `direction`, both in the face, first crosses the outline outwards. The edge of wedge
  /// `own` is left out: the line starts there.
  FaceExit exit(const WedgeFace& face, std::uint32_t own, const dvec3& point, const dvec3& direction) const;

 private:
  void add(std::size_t side, const OutlineEdge& edge);
  void add_wedge(std::span<const Wedge> wedges, std::uint32_t wedge, int face);
  void add_wedges(std::span<const Wedge> wedges);
  void add_creases(const TriangleMesh& mesh, double min_wedge_angle);

  std::unordered_map<std::size_t, std::vector<OutlineEdge>> edges_;  // at 2 patch + back, of those that have a convex wedge
};

}  // namespace raytube
