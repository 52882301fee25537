// Small geometry and the tolerances of the mesh room.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "core/field.h"

namespace raytube {

/// Three vertices by their indices.
using Triangle = std::array<std::uint32_t, 3>;

/// Vertices closer than this fraction of the bounding box's diagonal are one: a few roundings of a single-precision file.
inline constexpr double weld_fraction = 1e-7;
/// Vertices this fraction of the diagonal beside a plane or a line lie on it: what six digits of a text file leave of flat faces.
inline constexpr double flat_fraction = 2e-6;

/// And vertices so many steps of rounded coordinates (TriangleMesh::coordinate_step) beside a plane through others.
inline constexpr double rounding_steps = 4.0;

/// Of least size round points, sides along the axes; inside out while it holds none.
struct Box {
  dvec3 low{std::numeric_limits<double>::infinity()};    // least coordinates
  dvec3 high{-std::numeric_limits<double>::infinity()};  // largest coordinates

  /// Grows to hold the point.
  void add(const dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  /// The point half-way between its corners.
  dvec3 middle() const { return 0.5 * low + 0.5 * high; }
  /// Distance of opposite corners.
  double diagonal() const { return glm::length(high - low); }
};

/// The eight corners.
inline std::array<dvec3, 8> corners_of(const Box& box) {
  std::array<dvec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = {i & 1 ? box.low.x : box.high.x, i & 2 ? box.low.y : box.high.y, i & 4 ? box.low.z : box.high.z};
  return corners;
}

/// The box round all of them.
inline Box bounding_box(std::span<const dvec3> points) {
  Box box;
  for (const dvec3& p : points) box.add(p);
  return box;
}

/// The axis along which a vector is longest; ties go to the lowest.
inline int longest_axis(const dvec3& v) { return v.x >= v.y && v.x >= v.z ? 0 : v.y >= v.z ? 1 : 2; }

/// Twice the area times the unit normal.
inline dvec3 area_vector(const dvec3& a, const dvec3& b, const dvec3& c) { return glm::cross(b - a, c - a); }

/// Twice the area times the unit normal.
inline dvec3 area_vector(std::span<const dvec3> vertices, const Triangle& t) {
  return area_vector(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
}

/// The corner at which a triangle has a vertex of its own, 0 to 2.
inline std::uint32_t corner_at(const Triangle& t, std::uint32_t vertex) { return t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2; }

/// Whether the vertex is one of the triangle's.
inline bool has_corner(const Triangle& t, std::uint32_t vertex) { return t[0] == vertex || t[1] == vertex || t[2] == vertex; }

/// Whether two triangles have a vertex in common.
inline bool share_corner(const Triangle& a, const Triangle& b) {
  return has_corner(b, a[0]) || has_corner(b, a[1]) || has_corner(b, a[2]);
}

/// The corner after which the longest edge starts; ties go to the lowest.
inline int longest_edge(std::span<const dvec3> vertices, const Triangle& t) {
  int longest = 0;
  double length = -1.0;
  for (int k = 0; k < 3; ++k) {
    const double here = glm::length(vertices[t[(k + 1) % 3]] - vertices[t[k]]);
    if (here > length) longest = k;
    length = std::max(length, here);
  }
  return longest;
}

/// Distance of the longest edge from the corner opposite to it.
inline double height(std::span<const dvec3> vertices, const Triangle& t) {
  const int k = longest_edge(vertices, t);
  const double base = glm::length(vertices[t[(k + 1) % 3]] - vertices[t[k]]);
  return base > 0.0 ? glm::length(area_vector(vertices, t)) / base : 0.0;
}

}  // namespace raytube
