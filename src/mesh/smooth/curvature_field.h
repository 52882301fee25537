// Normals and curvatures all over curved surfaces, from their facets.
#pragma once

#include <vector>

#include "mesh/smooth/smooth.h"

namespace raytube {

/// A surface at a point of one of its facets. How its normal turns, dn/dr, is a symmetric matrix [1/m].
struct SurfaceFrame {
  dvec3 normal;             // unit, on the side that the facet's points to
  dvec3 square_turn{0.0};   // xx, yy, zz of that matrix
  dvec3 product_turn{0.0};  // its yz, zx, xy

  /// How the normal turns along t.
  dvec3 turn(const dvec3& t) const {
    const dvec3 &s = square_turn, &p = product_turn;
    return {s.x * t.x + p.z * t.y + p.y * t.z, p.z * t.x + s.y * t.y + p.x * t.z, p.y * t.x + p.x * t.y + s.z * t.z};
  }
  /// The normal curvature along t, positive where it is convex.
  double curvature(const dvec3& t) const { return glm::dot(t, turn(t)); }
  /// The determinant of what the matrix does within the tangent plane, normal . adj(dn/dr) normal [1/m^2].
  double gaussian() const {
    const dvec3 &s = square_turn, &p = product_turn, &n = normal;
    const double yz = p.y * p.z - s.x * p.x, zx = p.z * p.x - s.y * p.y, xy = p.x * p.y - s.z * p.z;
    return n.x * n.x * (s.y * s.z - p.x * p.x) + n.y * n.y * (s.z * s.x - p.y * p.y) + n.z * n.z * (s.x * s.y - p.z * p.z) +
           2.0 * (n.y * n.z * yz + n.z * n.x * zx + n.x * n.y * xy);
  }
  /// The same seen from that side: 1 the one its normal points to, -1 the other one.
  SurfaceFrame from(double side) const { return {side * normal, side * square_turn, side * product_turn}; }
};

/// Curvature of every facet from the normals at its corners, averaged at the vertices by area (Rusinkiewicz 2004, Estimating
/// curvatures and their derivatives on triangle meshes), linear over the facets. So neither changes at once from facet to facet
/// of one surface.
class CurvatureField {
 public:
  /// Keeps references to both.
  CurvatureField(const TriangleMesh& mesh, const SmoothSurfaces& surfaces);

  /// At barycentric coordinates of a triangle with a region: 1 - l.x - l.y, l.x, l.y.
  SurfaceFrame at(std::uint32_t triangle, const dvec2& l) const {
    const auto turn = [&](int corner) -> const Turn& { return turns_[surfaces_.normal_index(triangle, corner)]; };
    const Turn &a = turn(0), &b = turn(1), &c = turn(2);
    const double l0 = 1.0 - l.x - l.y;
    return {glm::normalize(normal(triangle, l)), l0 * a.squares + l.x * b.squares + l.y * c.squares,
            l0 * a.products + l.x * b.products + l.y * c.products};
  }

  /// The mean of a facet's normals there, not of unit length.
  dvec3 normal(std::uint32_t triangle, const dvec2& l) const {
    return (1.0 - l.x - l.y) * normal(triangle, 0) + l.x * normal(triangle, 1) + l.y * normal(triangle, 2);
  }

  const dvec3& normal(std::uint32_t triangle, int corner) const { return surfaces_.normal(triangle, corner); }

  const TriangleMesh& mesh() const { return mesh_; }            // as given
  const SmoothSurfaces& surfaces() const { return surfaces_; }  // as given
  /// What it holds for each normal of the surfaces.
  static constexpr std::size_t bytes_per_normal() { return sizeof(Turn); }

 private:
  // The entries of dn/dr, as those of SurfaceFrame.
  struct Turn {
    dvec3 squares{0.0}, products{0.0};
  };

  const TriangleMesh& mesh_;
  const SmoothSurfaces& surfaces_;
  std::vector<Turn> turns_;  // by SmoothSurfaces::normal_index()
};

}  // namespace raytube
