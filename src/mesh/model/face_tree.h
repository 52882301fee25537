// Which faces a bundle of parallel tubes may meet.
#pragma once

#include <array>
#include <limits>
#include <ranges>
#include <span>
#include <vector>

#include "mesh/model/faces.h"
#include "mesh/model/geometry.h"

namespace raytube {

/// What lies on one side of a plane: all points r with axis . r >= least. The axis is a unit vector.
struct PrismSide {
  dvec3 axis;    // across the plane
  double least;  // [m]
};

/// A bundle of parallel lines, bounded by a rectangle across them and by depths along them. Coordinates count from `base`.
struct Prism {
  dvec3 base;                                                 // recentred coordinates [m]
  dvec3 u_hat, v_hat, direction;                              // orthonormal
  dvec2 low, high;                                            // bounds along u_hat and v_hat
  double farthest = std::numeric_limits<double>::infinity();  // bound along `direction` [m]
  /// Bounds it further: only what reaches into all of these counts. Any number of them may be left out.
  static constexpr std::size_t most_sides = 8;
  std::array<PrismSide, most_sides> sides{};  // the first `side_count` of them
  std::size_t side_count = 0;                 // of these in use

  /// Bounds it by one more side while there is room.
  void add(const PrismSide& side) {
    if (side_count < most_sides) sides[side_count++] = side;
  }
};

/// A face and what holds it, while the tree is built.
struct BoxedFace {
  Box box;             // round it
  std::uint32_t face;  // its number
};

/// The faces of a mesh in a tree of boxes, eight to a node. Boxes are in single precision, enlarged by what that may cost.
class FaceTree {
 public:
  /// Keeps a reference to the mesh, which must outlive the tree.
  explicit FaceTree(const TriangleMesh& mesh);

  /// All faces in the order of the tree: neighbours in space are neighbours in number.
  std::span<const Face> faces() const { return faces_.faces; }
  /// The corners of a face, as vertices of the mesh.
  std::span<const std::uint32_t> corners(std::uint32_t face) const { return faces_.corners_of(faces_.faces[face]); }
  /// The corners of a face as points, in recentred coordinates [m].
  auto points(std::uint32_t face) const {
    return corners(face) | std::views::transform([this](std::uint32_t v) -> const dvec3& { return mesh_.vertices[v]; });
  }
  /// The triangles of a face.
  std::span<const std::uint32_t> triangles(std::uint32_t face) const { return triangles_[face]; }
  std::uint32_t face_of(std::uint32_t triangle) const { return faces_.face_of_triangle[triangle]; }  // number in faces()
  const TriangleMesh& mesh() const { return mesh_; }                                                 // as given

  /// Fills `found` with every face whose box reaches into the prism, in an order fixed by the tree. Gives up soon after the
  /// first `most` of them.
  void collect(const Prism& prism, std::vector<std::uint32_t>& found,
               std::size_t most = std::numeric_limits<std::size_t>::max()) const;

 private:
  static constexpr int lanes = 8;
  // Boxes side by side, so that a prism is held against all of them at once. Unused ones are inside out.
  using Lanes [[gnu::vector_size(lanes * sizeof(float))]] = float;
  // Aligned as vector instructions want it whoever includes this: without them, GCC takes less.
  struct alignas(lanes * sizeof(float)) Node {
    Lanes x, y, z;                                // middles
    Lanes half_x, half_y, half_z;                 // half the sides
    std::array<std::uint32_t, lanes> begin, end;  // faces
    std::array<std::uint32_t, lanes> child;       // 0: a leaf
  };
  struct Query;

  std::uint32_t build(std::span<BoxedFace> order, std::uint32_t begin);
  void set_lane(std::uint32_t node, int lane, const Box& box, std::uint32_t begin, std::uint32_t end, std::uint32_t child);

  const TriangleMesh& mesh_;
  Faces faces_;
  TriangleRows triangles_;  // of each face
  double box_rounding_;     // [m] what single precision may move the side of a box by
  std::vector<Node> nodes_;
};

}  // namespace raytube
