// The edges of a target that may illuminate other faces.
#pragma once

#include <vector>

#include "mesh/model/face_tree.h"
#include "utd/fringe/near_pieces.h"
#include "utd/interaction/edge_illumination.h"
#include "utd/shadow/edge_visibility.h"

namespace raytube {

/// Weight of a wave on a wedge, 0 to 1: that of its incidence, 0 along the edge (sine below 1e-4). At the edge of a thin plate
/// the weight goes smoothly from 0 in the plate's plane, where the edge's waves change their sign, to 1 at a degree from it.
double incidence_weight(const Wedge& wedge, const WedgeIncidence& incidence);

/// The lit part of a piece as a part of its wedge.
LitInterval along_wedge(const LitEdgePiece& piece);

/// A part of a lit piece in a wave that is plane along it.
struct PlainPart {
  LitInterval of_wedge;
  LookVectors look;
  double path;  // added to the phase that the plane waves of `look` have [m]
};

/// The parts of a piece in its wave, `look` but for that: the whole of it, or of antennas at a finite distance as many as make
/// both their waves plane along each on a target of this radius.
std::vector<PlainPart> plain_parts(const LitEdgePiece& piece, const LookVectors& look, std::span<const double> wavenumbers,
                                   double radius);

/// Axes of the radiating wedges in front of whose faces there is anything of the mesh, in the order of the wedges; none on a
/// convex body. They point into `wedges`. Waves of an edge that ends at another surface go on as its mirror does where that is a
/// conductor, or of one of the materials that are `mirrors`; others end them.
std::vector<EdgeAxis> edge_axes(const TriangleMesh& mesh, std::span<const Wedge> wedges, const std::vector<bool>& mirrors);

}  // namespace raytube
