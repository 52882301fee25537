// The section of a rounded edge, as a conic about its nose.
#pragma once

#include "core/field.h"
#include "utd/rounded/section_modes.h"

namespace raytube {

/// Part of a conic between two tangents, alike on both sides of its nose. At the angle theta of its normal from that at the nose
/// its radius is rho / (1 - e sin^2 theta)^(3/2): e = 0 an arc, 1 - b^2/a^2 the end of the axis a of an ellipse, 1 a parabola,
/// more a hyperbola with flanks at sin^2 theta = 1/e. Coordinates in its plane: x along the normal at the nose, which is the
/// origin.
struct ConicSection {
  double radius;      // rho [m]
  double flattening;  // e
  double end;         // theta at the tangents, in (0, pi/2)

  double radius_at(double theta) const;
  dvec2 at(double theta) const;

  double interior_angle() const { return pi - 2 * end; }
  /// The distance of the virtual apex, where the tangents meet, from the nose [m].
  double apex() const;
  /// The distance of the tangent points from the virtual apex [m].
  double tangent_distance() const { return at(end).y / std::cos(end); }
};

/// The arc of an edge.
inline ConicSection arc_of(double radius, double interior_angle) { return {radius, 0.0, (pi - interior_angle) / 2}; }

/// The section in the coordinates of section_modes().
Section section_of(const ConicSection& conic, double wavenumber);

}  // namespace raytube
