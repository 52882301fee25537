// Which triangles meet at which edge.
#pragma once

#include <span>
#include <vector>

#include "mesh/model/disjoint_sets.h"
#include "mesh/model/geometry.h"

namespace raytube {

/// The undirected edges of a triangle list, ordered by (lower, higher) vertex, each with its sides in order of triangles.
class EdgeTable {
 public:
  /// An edge as one triangle's side: from corner `corner` to the next one.
  struct Side {
    /// Of fewer than 2^30 triangles, which would take some 300 GB.
    Side(std::uint32_t of, std::uint32_t at) : triangle(of & 0x3fffffffu), corner(at & 3u) {}
    std::uint32_t triangle : 30;  // whose side it is
    std::uint32_t corner : 2;     // where the side begins, 0 to 2
  };
  /// Two vertices and the triangles that meet between them.
  struct Edge {
    std::uint32_t low, high;      // vertices
    std::span<const Side> sides;  // in order of triangles

    /// Of two sides, that of the other triangle.
    const Side& beside(std::uint32_t triangle) const { return sides[sides[0].triangle == triangle ? 1 : 0]; }
  };

  /// Triangles index vertices below `vertex_count`.
  EdgeTable(std::span<const Triangle> triangles, std::size_t vertex_count);

  /// Number of edges.
  std::size_t size() const { return ends_.size(); }
  /// The edge of this number, below size().
  Edge operator[](std::size_t edge) const;

  /// The edge from `corner` of `triangle` to its next corner.
  std::uint32_t edge_of(std::uint32_t triangle, int corner) const { return edge_of_side_[3 * std::size_t{triangle} + corner]; }

  /// The edge between two vertices, the lower one first; size() if there is none.
  std::size_t find(std::uint32_t low, std::uint32_t high) const;

 private:
  struct Ends {
    std::uint32_t low, high;
    std::uint32_t first_side;
  };

  std::vector<Side> sides_;
  std::vector<Ends> ends_;
  std::vector<std::uint32_t> edge_of_side_;
};

/// Groups of triangles that hang together through the edges for which `crossable(edge)` holds: a number for each triangle.
template <class Crossable>
std::vector<std::uint32_t> connected_groups(const EdgeTable& edges, std::size_t triangle_count, Crossable crossable) {
  DisjointSets groups(triangle_count);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const EdgeTable::Edge edge = edges[e];
    if (!crossable(edge)) continue;
    for (const EdgeTable::Side& side : edge.sides) groups.join(edge.sides[0].triangle, side.triangle);
  }
  return groups.numbers();
}

}  // namespace raytube
