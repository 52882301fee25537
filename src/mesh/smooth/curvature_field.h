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

/// A facet of a curved surface as those who walk over it need it, in one place.
struct CurvedFacet {
  /// The triangle beside it, and the corner at which its side begins there; no_index where the surface ends.
  struct Neighbour {
    std::uint32_t triangle, corner;
  };

  BentFacet shape;
  dvec3 plane_normal;
  dvec3 gradient_1, gradient_2;          // of barycentric coordinates l1 and l2, in its plane [1/m]
  std::array<std::uint32_t, 3> corners;  // by SmoothSurfaces::normal_index()
  std::array<Neighbour, 3> beyond;       // each side, from its corner to the next
};

/// Curvature of every facet from the normals at its corners, averaged at the vertices by area (Rusinkiewicz 2004, Estimating
/// curvatures and their derivatives on triangle meshes), linear over the facets. So neither changes at once from facet to facet
/// of one surface.
class CurvatureField {
 public:
  /// Keeps a reference to the second.
  CurvatureField(const TriangleMesh& mesh, const SmoothSurfaces& surfaces);

  /// At barycentric coordinates of a triangle with a region: 1 - l.x - l.y, l.x, l.y.
  SurfaceFrame at(std::uint32_t triangle, const dvec2& l) const {
    const auto& [a, b, c] = facet(triangle).corners;
    const double l0 = 1.0 - l.x - l.y;
    const auto mean = [&](dvec3 SurfaceFrame::*of) { return l0 * frames_[a].*of + l.x * frames_[b].*of + l.y * frames_[c].*of; };
    return {glm::normalize(mean(&SurfaceFrame::normal)), mean(&SurfaceFrame::square_turn), mean(&SurfaceFrame::product_turn)};
  }

  /// The mean of a facet's normals there, not of unit length.
  dvec3 normal(const CurvedFacet& facet, const dvec2& l) const {
    const auto& [a, b, c] = facet.corners;
    return (1.0 - l.x - l.y) * frames_[a].normal + l.x * frames_[b].normal + l.y * frames_[c].normal;
  }

  const dvec3& normal(std::uint32_t triangle, int corner) const { return surfaces_.normal(triangle, corner); }

  /// That of a triangle with a region.
  const CurvedFacet& facet(std::uint32_t triangle) const { return facets_[facet_of_[triangle]]; }

 private:
  const SmoothSurfaces& surfaces_;
  std::vector<std::uint32_t> facet_of_;  // [triangle]
  std::vector<CurvedFacet> facets_;
  std::vector<SurfaceFrame> frames_;  // by SmoothSurfaces::normal_index()
};

}  // namespace raytube
