// Where the wave of one edge jumps or bends along the rim of another face, and where panels of quadrature end there.
#pragma once

#include <optional>
#include <vector>

#include "utd/interaction/edge_illumination.h"
#include "utd/wedge/diffracted_field.h"

namespace raytube {

/// The boundary on which, within rounding_of_files, an observation angle lies, of a wave from this source angle [rad].
std::optional<double> boundary_at(double n, double source, double observation);

/// Ends of panels along a rim [m], which grow from its ends, where it may meet the edge that lights it, to its middle; they end
/// where shadow and reflection boundaries cut it, too, and on the cones of rays from both ends of the lit piece.
std::vector<double> rim_panels(const StraightEdge& lit, const RaySource& source, double source_angle, const EdgeAxis& rim,
                               double wavelength);

}  // namespace raytube
