// Wedge edges of a mesh: where two exposed faces, or the two sides of an open surface, meet at an angle.
//
// mesh/features finds in a TriangleMesh what the methods ask for: free sectors around edges (edge_sectors), wedges and
// the outlines of their faces, thin plates, surfaces that facets stand for (smooth), symmetry, convexity, what is enclosed.
// Notation, as of the edge currents: faces 0 and 1 of a wedge, each with x_f (into_face) and n_f (normal), t (tangent).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesh/model/edge_table.h"
#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// One of the two faces of a wedge, as it looks from the free space between them.
struct WedgeFace {
  std::uint32_t patch = no_index;     // whose side the face is
  dvec3 into_face;                    // x_f: unit, in the face, perpendicular to the edge, away from it
  dvec3 normal;                       // n_f: unit, out of the metal into the free space of this wedge
  double width = 0.0;                 // extent of the patch along into_face [m]
  bool back = false;                  // the side of the patch that its normal points away from
  std::uint32_t material = no_index;  // of the patch
};

/// A straight edge with free space between faces[0] and faces[1]; angles are measured from faces[0] through free space,
/// counter-clockwise about tangent() = into_face x normal of faces[0]; for faces[1] the same product is -tangent().
struct Wedge {
  dvec3 start, end;                // recentred coordinates [m]
  double n = 0.0;                  // exterior (free-space) angle / pi: 2 half plane, 1.5 outer edge of a cube, 0.5 inner corner
  std::array<WedgeFace, 2> faces;  // as seen from the free space between them
  bool enclosed = false;           // inside a closed body, where no wave comes (mark_enclosed)
  std::uint32_t replaced_by = no_index;  // of an edge of a thin plate's border face: the half plane that stands for it

  // Of a half plane that stands for the border face of a thin plate (merge_thin_plate_edges); else 0 and no_index.
  dvec3 thickness_vector{0.0};               // from one side of the plate to the other over the border face [m]
  std::uint32_t border_patch = no_index;     // the border face; of a wedge with unresolved details the narrow face beside it
  std::uint32_t border_material = no_index;  // of the border face

  // Where its faces are details that a wave does not resolve (resolve_details):
  double share = 1.0;  // of several wedges that the wave sees as one, this one's
  bool flat = false;   // the wave sees no wedge at all

  /// More free space than half of all directions: an outer edge.
  bool convex() const { return n > 1.0; }
  /// Both faces are perfect conductors.
  bool conducting() const {
    return std::ranges::all_of(faces, [](const WedgeFace& face) { return face.material == no_index; });
  }
  /// Its faces are the two sides of one patch, which ends here.
  bool is_border() const { return faces[0].patch == faces[1].patch; }
  /// It has fringe currents of its own: it is convex to a wave, and no half plane of a thin plate stands for it.
  bool stands_alone() const { return convex() && !flat && replaced_by == no_index; }
  /// Its fringe currents radiate: it stands alone, waves reach it, and both faces conduct.
  bool radiates() const { return stands_alone() && !enclosed && conducting(); }
  double thickness() const { return std::abs(glm::dot(thickness_vector, faces[0].normal)); }  // of a thin plate, else 0 [m]
  double interior_angle() const { return (2.0 - n) * pi; }                                    // metal side [rad]
  double length() const { return glm::length(end - start); }                                  // [m]
  dvec3 at(double fraction) const { return start + fraction * (end - start); }                  // a point of it
};

/// All wedges, convex and concave, whose faces differ from a plane by at least `min_wedge_angle` [rad]: |pi - interior| >= it.
/// The bends of the mesh are none. Around every welded edge the incident facets are sorted by angle; each sector of free space
/// between two exposed facet sides is a wedge. So a border is one half plane (n = 2), an edge of a closed body one wedge, a
/// crease in an open surface two (n and 2 - n), and an edge where several open surfaces meet one per free sector. Collinear
/// neighbours with the same faces merge. In the order of the mesh's edges, each run where its first edge stands.
std::vector<Wedge> find_wedges(const TriangleMesh& mesh, double min_wedge_angle);

}  // namespace raytube
