// The triangles of a mesh in a tree of boxes, each turned as its triangles lie.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// Boxes along the axes do for compact triangles. Slender ones in a fan or round the tip of a cone fill theirs so little that
/// each would seem to meet each: those have boxes turned as they lie.
class TriangleTree {
 public:
  /// Keeps a reference to the mesh.
  explicit TriangleTree(const TriangleMesh& mesh);

  /// Each two triangles of different patches, without a common corner, that may be as near as `distance` and that `accept` takes.
  /// In an order fixed by the tree; `accept` must be thread-safe.
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  Pairs close_pairs(double distance, const std::function<bool(std::uint32_t, std::uint32_t)>& accept) const;

  /// Fills `found` with all triangles that the line meets, in an order fixed by the tree, and some that it passes by.
  void near_line(const dvec3& origin, const dvec3& direction, std::vector<std::uint32_t>& found) const;

 private:
  using Axes = std::array<dvec3, 3>;
  struct TurnedBox {
    dvec3 middle{0.0};
    dvec3 half{0.0};         // sides, along the axes
    std::uint32_t axes = 0;  // number of these; 0: those of space
  };
  struct Node {
    TurnedBox box;
    std::uint32_t begin, end;             // members
    std::uint32_t right = 0;              // second child, the first one follows its parent; 0 in leaves
    std::uint32_t patch;                  // of all members, or no_index
    std::array<std::uint32_t, 3> common;  // vertices that all members share; no_index fills the rest
  };
  class Builder;
  class Join;

  TurnedBox box_round(std::span<const dvec3> points);
  bool are_apart(const TurnedBox& a, const TurnedBox& b, double distance) const;
  bool turned_are_apart(const TurnedBox& a, const TurnedBox& b, double distance) const;

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> members_;
  std::vector<Node> nodes_;
  std::vector<Axes> axes_;  // of turned boxes; few triangles need any
};

}  // namespace raytube
