// Thin sheets: modelled as a closed body, a sheet ends in a rim, a narrow face between two edges. To a wave much longer than the
// rim is wide these two are one, the edge of a half plane.
#pragma once

#include <span>
#include <vector>

#include "mesh/features/wedges.h"

namespace raytube {

/// A narrow face of a closed body between two convex edges whose other faces are the two sides of a sheet.
struct ThinPlateEdge {
  std::array<std::uint32_t, 2> edges{};  // wedges
  std::array<WedgeFace, 2> sides;        // their faces on the sheet
  std::uint32_t patch = no_index;        // the rim
  dvec3 across;                          // from one edge to the other over it, half-way along [m]
  double width = 0.0;                    // thickness of the sheet there [m]
  dvec3 start, end;                      // the line amid the rim, t = x_f x n_f of sides[0] from start to end
};

/// All rims, narrowest first. The sides are parallel and so are the edges, within 3 degrees; the rim stands upright on them
/// within 20 degrees; either side is at least twice as broad as the rim is wide, both ways, and half of the shorter edge faces
/// the other one. What counts as thin is for the wavelength to say: the sides of a cube's faces would be rims if the cube were
/// flatter.
std::vector<ThinPlateEdge> find_thin_plate_edges(const TriangleMesh& mesh, std::span<const Wedge> wedges);

/// Rims narrower than this are thin [m].
inline double thin_limit(double frequency) { return wavelength(frequency) / 10; }
std::size_t thin_rims(std::span<const ThinPlateEdge> rims, double frequency);

/// The same wedges and, after them, one half plane for each rim narrower than `limit` [m], which the edges of that rim name.
/// Edges are cut where they bound the rim on a part of their length only. Edges that stand on a rim and are no longer than it is
/// wide, its corners, name it too. With no such rim the wedges come back as they are.
std::vector<Wedge> merge_thin_plate_edges(std::span<const Wedge> wedges, std::span<const ThinPlateEdge> rims, double limit);

/// How many of these wedges are corners of rims: no half plane has a face in common with them, so nothing stands for them.
std::size_t thin_plate_corners(std::span<const Wedge> merged);

}  // namespace raytube
