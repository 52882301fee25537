// The edges across which facets may be chords of one smooth surface, and how wide the facets are beside them.
#pragma once

#include <limits>
#include <vector>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// Of each plane the corners of its convex hull, and perhaps more points of its border.
struct PlaneOutlines {
  std::vector<std::uint32_t> first, vertices;  // outline p is vertices[first[p]] to vertices[first[p + 1] - 1]
};

/// Which edges of a mesh are creases, and across which a smooth surface may go on.
class Creases {
 public:
  /// What turns by less than `max_turn` [rad] is tessellation, and the bends of the mesh are. Keeps a reference to the mesh.
  Creases(const TriangleMesh& mesh, double max_turn);

  /// Those of the mesh.
  const EdgeTable& edges() const { return mesh_.edges(); }

  /// Cosine of the steepest turn between two triangles that a smooth surface may go on across, bends left out.
  double steepest_crossed() const { return steepest_crossed_; }
  /// Cosine of the flattest turn that it may not.
  double flattest_left() const { return flattest_left_; }

  /// Whether a smooth surface may go on across the edge; and whether it would turn there.
  bool crossable(std::size_t edge) const { return crossable_[edge]; }
  /// Whether the surface turns there by more than tessellation does.
  bool is_crease(const EdgeTable::Edge& edge) const;

  /// A number in common for the triangles of one plane that hang together. Materials cut patches, but change nothing about the
  /// shape.
  std::uint32_t plane(std::uint32_t triangle) const { return plane_[mesh_.triangle_patch[triangle]]; }
  /// Number of planes: those of plane().
  std::size_t planes() const { return outlines_.first.size() - 1; }

  /// How far a triangle reaches from its side on the edge [m].
  double width(const EdgeTable::Edge& edge, const EdgeTable::Side& side) const;

  /// Whether a plane reaches further than `width` [m] from an edge of it.
  bool reaches(std::uint32_t plane, const EdgeTable::Edge& edge, double width) const;

 private:
  void find_crossable(double least_cosine);

  const TriangleMesh& mesh_;
  double steepest_crossed_ = std::numeric_limits<double>::infinity(), flattest_left_ = -steepest_crossed_;
  std::vector<std::uint32_t> plane_;  // of each patch
  PlaneOutlines outlines_;
  std::vector<bool> crossable_;
};

}  // namespace raytube
