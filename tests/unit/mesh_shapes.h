// Small shapes for the mesh tests, as polygon soups, and what every mesh must satisfy.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <set>

#include "mesh/features/wedges.h"
#include "mesh/load.h"

namespace raytube::shapes {

using Polygon = std::vector<std::uint32_t>;

inline PolygonSoup box(const dvec3& low, const dvec3& high) {
  PolygonSoup soup;
  for (int i = 0; i < 8; ++i) soup.points.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  soup.polygons = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return soup;
}

inline PolygonSoup cube() { return box(dvec3(0.0), dvec3(1.0)); }

/// A parallelogram.
inline PolygonSoup plate(const dvec3& corner, const dvec3& a, const dvec3& b) {
  return {{corner, corner + a, corner + a + b, corner + b}, {{0, 1, 2, 3}}};
}

inline void append(PolygonSoup& soup, const PolygonSoup& other) {
  const auto offset = static_cast<std::uint32_t>(soup.points.size());
  soup.points.insert(soup.points.end(), other.points.begin(), other.points.end());
  for (Polygon polygon : other.polygons) {
    for (std::uint32_t& corner : polygon) corner += offset;
    soup.polygons.push_back(polygon);
  }
}

inline PolygonSoup joined(PolygonSoup first, const PolygonSoup& second) {
  append(first, second);
  return first;
}

/// Every quad becomes rows x columns x 2 triangles with corners of their own.
inline PolygonSoup remeshed(const PolygonSoup& quads, int rows, int columns) {
  PolygonSoup soup;
  for (const Polygon& q : quads.polygons) {
    const auto at = [&](int i, int k) {
      const double u = double(i) / rows, v = double(k) / columns;
      return (1 - u) * ((1 - v) * quads.points[q[0]] + v * quads.points[q[3]]) +
             u * ((1 - v) * quads.points[q[1]] + v * quads.points[q[2]]);
    };
    for (int i = 0; i < rows; ++i)
      for (int k = 0; k < columns; ++k)
        append(soup, {{at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)}, {{0, 1, 2}, {0, 2, 3}}});
  }
  return soup;
}

/// A right prism on a counter-clockwise outline in the plane z = 0; the two ends are single polygons.
inline PolygonSoup prism(const std::vector<dvec2>& outline, double height) {
  PolygonSoup soup;
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const dvec2& p : outline) soup.points.push_back({p.x, p.y, 0.0});
  for (const dvec2& p : outline) soup.points.push_back({p.x, p.y, height});
  Polygon bottom, top;
  for (std::uint32_t i = 0; i < n; ++i) {
    bottom.push_back(n - 1 - i);
    top.push_back(n + i);
    soup.polygons.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  soup.polygons.push_back(bottom);
  soup.polygons.push_back(top);
  return soup;
}

inline PolygonSoup cylinder(int sides) {
  std::vector<dvec2> outline;
  for (int i = 0; i < sides; ++i) outline.push_back({std::cos(2 * pi * i / sides), std::sin(2 * pi * i / sides)});
  return prism(outline, 2.0);
}

inline PolygonSoup sphere(int rings) {
  PolygonSoup soup;
  const int n = 2 * rings;
  const auto at = [&](int i, int k) {
    const double theta = pi * i / rings, phi = 2 * pi * (k % n) / n;
    return i == 0 || i == rings ? dvec3(0, 0, i == 0 ? 1 : -1)
                                : dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  };
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < n; ++k) {
      if (i + 1 < rings) append(soup, {{at(i, k), at(i + 1, k), at(i + 1, k + 1)}, {{0, 1, 2}}});
      if (i > 0) append(soup, {{at(i, k), at(i + 1, k + 1), at(i, k + 1)}, {{0, 1, 2}}});
    }
  return soup;
}

inline PolygonSoup moved(PolygonSoup soup, const glm::dmat3& rotation, const dvec3& shift = dvec3(0.0)) {
  for (dvec3& p : soup.points) p = rotation * p + shift;
  return soup;
}

/// Rounds every coordinate to single precision. Without volatile GCC 12 leaves the rounding out when it vectorises the loop.
inline PolygonSoup in_single_precision(PolygonSoup soup) {
  for (dvec3& p : soup.points)
    for (int axis = 0; axis < 3; ++axis) {
      const volatile float rounded = static_cast<float>(p[axis]);
      p[axis] = rounded;
    }
  return soup;
}

/// A rotation with no axis, angle or entry that is special.
inline glm::dmat3 skew_rotation() { return glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.7, dvec3(0.3, -1.1, 0.45))); }

inline double area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += 0.5 * glm::length(glm::cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
  return sum;
}

inline double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += glm::dot(mesh.vertices[a], glm::cross(mesh.vertices[b], mesh.vertices[c])) / 6.0;
  return sum;
}

/// Nothing is lost in silence, and all indices fit.
inline void expect_consistent(const LoadedMesh& loaded) {
  const auto& [mesh, report] = loaded;
  EXPECT_EQ(report.triangles_read + report.triangles_added,
            report.triangles_traced + report.triangles_degenerate + report.triangles_duplicate + report.triangles_internal);
  EXPECT_EQ(report.triangles_traced, mesh.triangles.size());
  ASSERT_EQ(mesh.triangle_patch.size(), mesh.triangles.size());
  ASSERT_EQ(mesh.triangle_component.size(), mesh.triangles.size());
  std::vector<std::uint32_t> triangles(mesh.components.size(), 0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    ASSERT_LT(mesh.triangle_patch[i], mesh.patches.size());
    ASSERT_LT(mesh.triangle_component[i], mesh.components.size());
    ++triangles[mesh.triangle_component[i]];
    for (const std::uint32_t v : mesh.triangles[i]) ASSERT_LT(v, mesh.vertices.size());
  }
  for (std::size_t c = 0; c < triangles.size(); ++c) EXPECT_EQ(mesh.components[c].triangles, triangles[c]);
  for (const Patch& patch : mesh.patches) EXPECT_NEAR(glm::length(patch.normal), 1.0, 1e-15);
}

inline LoadedMesh build(const PolygonSoup& soup, double metres_per_unit = 1.0) {
  LoadedMesh loaded = build_mesh(soup, metres_per_unit);
  expect_consistent(loaded);
  return loaded;
}

/// The frames obey the conventions of mesh/features/wedges.h; tolerances are a few roundings of unit vectors.
inline void expect_proper(const Wedge& wedge) {
  const dvec3 tangent = glm::normalize(wedge.end - wedge.start);
  for (int i = 0; i < 2; ++i) {
    const WedgeFace& face = wedge.faces[i];
    EXPECT_NEAR(glm::length(face.into_face), 1.0, 1e-14);
    EXPECT_NEAR(glm::length(face.normal), 1.0, 1e-14);
    const dvec3 expected = i == 0 ? tangent : -tangent;
    EXPECT_NEAR(glm::distance(glm::cross(face.into_face, face.normal), expected), 0.0, 1e-14);
    EXPECT_GT(face.width, 0.0);
  }
  const WedgeFace &first = wedge.faces[0], &second = wedge.faces[1];
  const dvec3 turned = std::cos(wedge.n * pi) * first.into_face + std::sin(wedge.n * pi) * first.normal;
  EXPECT_NEAR(glm::distance(turned, second.into_face), 0.0, 1e-14);
}

inline std::vector<Wedge> wedges_of(const LoadedMesh& loaded, double min_degrees = 15.0) {
  std::vector<Wedge> wedges = find_wedges(loaded.mesh, min_degrees * degree);
  for (const Wedge& wedge : wedges) expect_proper(wedge);
  return wedges;
}

/// Number of wedges for each n, rounded to a thousandth.
inline std::map<double, int> count_by_n(const std::vector<Wedge>& wedges) {
  std::map<double, int> count;
  for (const Wedge& wedge : wedges) ++count[std::round(1000.0 * wedge.n) / 1000.0];
  return count;
}

inline double total_length(const std::vector<Wedge>& wedges) {
  double sum = 0.0;
  for (const Wedge& wedge : wedges) sum += wedge.length();
  return sum;
}

using Count = std::map<double, int>;

}  // namespace raytube::shapes
