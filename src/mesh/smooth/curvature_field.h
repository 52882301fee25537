// Normals and curvatures all over curved surfaces, from their facets.
#pragma once

#include <vector>

#include "mesh/smooth/smooth.h"

namespace raytube {

/// A surface at a point of one of its facets.
struct SurfaceFrame {
  dvec3 normal;            // unit, on the side that the facet's points to
  glm::dmat3 normal_turn;  // dn/dr [1/m]: t . normal_turn t is the normal curvature along t, positive where it is convex

  double curvature(const dvec3& t) const { return glm::dot(t, normal_turn * t); }
  double gaussian() const;  // [1/m^2]
};

/// Curvature of every facet from the normals at its corners, averaged at the vertices by area (Rusinkiewicz 2004, Estimating
/// curvatures and their derivatives on triangle meshes), linear over the facets. So neither changes at once from facet to facet
/// of one surface.
class CurvatureField {
 public:
  /// Keeps references to both.
  CurvatureField(const TriangleMesh& mesh, const SmoothSurfaces& surfaces);

  /// At barycentric coordinates of a triangle with a region: 1 - l.x - l.y, l.x, l.y.
  SurfaceFrame at(std::uint32_t triangle, const dvec2& l) const;

  const dvec3& normal(std::uint32_t triangle, int corner) const { return surfaces_.normal(triangle, corner); }

 private:
  glm::dmat3 of_facet(std::uint32_t triangle) const;

  const TriangleMesh& mesh_;
  const SmoothSurfaces& surfaces_;
  std::vector<glm::dmat3> turns_;  // by SmoothSurfaces::normal_index()
};

}  // namespace raytube
