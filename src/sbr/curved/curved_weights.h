// Physical optics on a curved surface of another material than a perfect conductor.
#pragma once

#include "sbr/curved/curved_piece.h"

namespace raytube {

/// What curved_far_field() is there: at every point the currents of the plane that touches the surface.
std::vector<ScatteringMatrix> curved_weights_far_field(const Illumination& light, const CurvedPiece& piece, const Bounds& cell,
                                                       TubeSums* sums);
std::vector<ScatteringMatrix> curved_weights_far_field(const Illumination& light, const CurvedPiece& piece,
                                                       const ConvexPolygon& polygon, TubeSums* sums);

}  // namespace raytube
