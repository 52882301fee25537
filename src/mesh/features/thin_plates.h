// Thin plates: modelled as a closed body, a metal plate ends in a border face, narrow, between two parallel edges. To a wave much
// longer than the plate is thick these two are one, the edge of a half plane. Of a coated plate that is said of its metal.
#pragma once

#include <span>
#include <vector>

#include "mesh/features/wedges.h"

namespace raytube {

/// A border face, with the two convex edges that bound it and whose other faces are the two sides of the plate.
struct ThinPlateEdge {
  std::array<std::uint32_t, 2> edges{};      // wedges
  std::array<WedgeFace, 2> sides;            // their faces on the sides of the plate
  std::uint32_t border_patch = no_index;     // the border face
  std::uint32_t border_material = no_index;  // its material
  dvec3 thickness_vector;                    // from one edge to the other over the border face, half-way along [m]
  double thickness = 0.0;                    // of the plate there [m]
  double effective = 0.0;  // what has to be thin: the thickness without coats, but at least half of the whole [m]
  dvec3 start, end;        // the middle line of the border face, t = x_f x n_f of sides[0] from start to end
};

/// All of them, of plates of any material, thinnest first. The sides are parallel and so are the edges, within 3 degrees; the
/// border face stands upright on them within 20 degrees; either side is at least twice as broad as the plate is thick, both ways,
/// and half of the shorter edge faces the other one. What counts as thin is for the wavelength to say: the faces between the
/// sides of a cube would be border faces if the cube were flatter.
std::vector<ThinPlateEdge> find_thin_plate_edges(const TriangleMesh& mesh, std::span<const Wedge> wedges);

/// By what has to be thin.
void sort_thinnest_first(std::vector<ThinPlateEdge>& edges);

/// Plates effectively thinner than this are thin at `frequency` [Hz]: a tenth of the wavelength [m].
inline double thin_limit(double frequency) { return wavelength(frequency) / 10; }
/// How many of these edges are edges of plates that are thin at `frequency` [Hz].
std::size_t count_thin(std::span<const ThinPlateEdge> edges, double frequency);

/// The wedges given and, after them, one half plane for each thin-plate edge whose plate is effectively thinner than `limit` [m];
/// the wedges it stands for name it in `replaced_by`. Wedges are cut where they bound the border face on a part of their length
/// only. Wedges that run across a border face, no longer than the plate is thick, its corners, name it too. Without a thin plate
/// the wedges come back as they are.
std::vector<Wedge> merge_thin_plate_edges(std::span<const Wedge> wedges, std::span<const ThinPlateEdge> edges, double limit);

/// How many of `merged` are corners of border faces: the half plane they name has no face in common with them, so nothing stands
/// for them.
std::size_t thin_plate_corners(std::span<const Wedge> merged);

}  // namespace raytube
