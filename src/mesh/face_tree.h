// Which faces a bundle of parallel tubes may meet.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "mesh/faces.h"
#include "mesh/geometry.h"

namespace raytube {

/// A bundle of parallel lines, bounded by a rectangle across them and by depths along them. Coordinates count from `base`.
struct Prism {
  dvec3 base;
  dvec3 u_hat, v_hat, direction;  // orthonormal
  dvec2 low, high;                // bounds along u_hat and v_hat
  double farthest = std::numeric_limits<double>::infinity();
  const Patch* floor = nullptr;  // the plane the lines start from: only what reaches above it, on the side of `direction`, counts
};

/// The faces of a mesh in a binary tree of boxes, in double precision.
class FaceTree {
 public:
  explicit FaceTree(const TriangleMesh& mesh);

  /// In the order of the tree: neighbours in space are neighbours in number.
  std::span<const Face> faces() const { return faces_.faces; }
  std::span<const std::uint32_t> corners(std::uint32_t face) const { return faces_.corners_of(faces_.faces[face]); }
  const TriangleMesh& mesh() const { return mesh_; }

  /// Fills `found` with every face whose box reaches into the prism, in increasing order.
  void collect(const Prism& prism, std::vector<std::uint32_t>& found) const;

 private:
  struct Node {
    dvec3 middle, half;          // of the box
    std::uint32_t begin, end;    // faces
    std::uint32_t second_child;  // 0: a leaf. The first child follows its parent.
  };

  void build(std::span<const Box> boxes, std::span<std::uint32_t> order, std::uint32_t begin);

  const TriangleMesh& mesh_;
  Faces faces_;
  std::vector<Node> nodes_;
};

}  // namespace raytube
