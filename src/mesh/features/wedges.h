// Wedge edges of a mesh: where two exposed faces, or the two sides of an open sheet, meet at an angle.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// One of the two faces of a wedge, seen from the free space between them.
struct WedgeFace {
  std::uint32_t patch = no_index;
  dvec3 into_face;                    // x_f: unit, in the face, perpendicular to the edge, away from it
  dvec3 normal;                       // n_f: unit, out of the metal into the free space of this wedge
  double width = 0.0;                 // extent of the patch along into_face [m]
  bool back = false;                  // the side of the patch that its normal points away from
  std::uint32_t material = no_index;  // of the patch
};

/// A straight edge with free space between faces[0] and faces[1]; angles are measured from faces[0] through free space,
/// counter-clockwise about tangent() = into_face x normal of faces[0]; for faces[1] the same product is -tangent().
struct Wedge {
  dvec3 start, end;  // recentred coordinates [m]
  double n = 0.0;    // exterior (free-space) angle / pi: 2 half plane, 1.5 outer edge of a cube, 0.5 inner corner
  std::array<WedgeFace, 2> faces;
  dvec3 across{0.0};             // not 0: this is the edge of a thin sheet, amid its rim; from side 0 to side 1 over it [m]
  std::uint32_t rim = no_index;  // then the patch of that rim
  std::uint32_t half_plane = no_index;  // this edge bounds the rim of a thin sheet: the wedge that stands for it (thin_sheets.h)
  bool enclosed = false;                // inside a closed body, where no light comes (mark_enclosed)

  bool convex() const { return n > 1.0; }
  /// Both faces are perfect conductors.
  bool conducting() const {
    return std::ranges::all_of(faces, [](const WedgeFace& face) { return face.material == no_index; });
  }
  /// Fringe currents are found for it: it is no edge of a thin plate that another wedge stands for.
  bool stands_alone() const { return convex() && half_plane == no_index; }
  /// They radiate: light reaches it, and both faces conduct.
  bool radiates() const { return stands_alone() && !enclosed && conducting(); }
  double thickness() const { return std::abs(glm::dot(across, faces[0].normal)); }  // of the sheet, 0 for a sharp edge [m]
  double interior_angle() const { return (2.0 - n) * pi; }                          // metal side [rad]
  double length() const { return glm::length(end - start); }
};

/// All wedges, convex and concave, whose faces differ from a plane by at least `min_wedge_angle` [rad]: |pi - interior| >= it.
/// Around every welded edge the incident facets are sorted by angle; each sector of free space between two exposed facet
/// sides is a wedge. So a border is one half plane (n = 2), an edge of a closed body one wedge, a fold in an open sheet two
/// (n and 2 - n), and an edge where several sheets meet one per free sector. Collinear neighbours with the same faces merge.
std::vector<Wedge> find_wedges(const TriangleMesh& mesh, double min_wedge_angle);

}  // namespace raytube
