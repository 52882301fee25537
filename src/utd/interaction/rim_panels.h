// Where the wave of one edge jumps or bends along the rim of another face, and where panels of quadrature end there.
#pragma once

#include <optional>
#include <vector>

#include "utd/interaction/edge_illumination.h"
#include "utd/wedge/diffracted_field.h"

namespace raytube {

/// Within so small an angle of a shadow or reflection boundary rounding, and that of files of few digits, decides the side [rad].
inline constexpr double undecided = 1e-5;

/// The boundary on which, or undecidedly beside which, an observation angle lies, of a wave from this source angle [rad].
std::optional<double> boundary_at(double n, double source, double observation);

/// Ends of panels along a rim [m], which grow from its ends, where it may meet the edge that lights it, to its middle; they end
/// where shadow and reflection boundaries cut it, too, and on the cones of rays from both ends of the lit piece.
std::vector<double> rim_panels(const StraightEdge& lit, const RaySource& source, double source_angle, const EdgeAxis& rim,
                               double wavelength);

}  // namespace raytube
