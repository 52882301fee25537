// What one tolerance, given in decibels, means for each thing that is held to it.
#pragma once

#include <cmath>

#include "scene/tolerance.h"

namespace raytube {

/// Phase [rad] by which a current may be off: one wrong by a small phase is wrong by as large a share of itself, since
/// |e^{jx} - 1| = x to first order.
inline double phase_tolerance(double relative_tolerance) { return relative_tolerance; }

/// Share of a part's largest amplitude by which a spherical wave's amplitude in the middle of a side may lie off the mean of the
/// side's ends before the side is halved: quadrature then leaves quadrature_error() = 0.3 per cent of the tolerance, as side
/// lobes are held to it as well.
inline double bend_tolerance(double relative_tolerance) { return std::sqrt(0.05 * relative_tolerance); }

/// Share of its far field that a parabola through ends and middles leaves where the middles lie off the mean of the ends by
/// `bend`.
inline double quadrature_error(double bend) { return bend * bend / 15.0; }

/// Amplitude [m] that quadrature may leave of the diffraction between edges and faces, of a target that returns `level` [m]: a
/// twentieth of the tolerance. Quadratures of a frequency alone and of several stop at different errors: below 1e-6 of S then.
inline double interaction_quadrature_error(double relative_tolerance, double level) { return 0.05 * relative_tolerance * level; }

}  // namespace raytube
