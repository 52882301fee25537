// Phase integrals over convex polygons of the launch plane, in closed form.
#pragma once

#include <vector>

#include "math/chebyshev.h"
#include "sbr/beams/footprint.h"
#include "sbr/launch/convex_polygon.h"

namespace raytube {

/// Mean of e^{jx} over a triangle on which x is linear, from x at its corners: twice the second divided difference of -e^{jx}
/// (Hermite-Genocchi). Error below 1e-14 for any corners, equal ones too.
Complex triangle_phase_mean(double x1, double x2, double x3);

/// Integral of the footprint's phase factor e^{jk (phase + phase_u u + phase_v v)} over a polygon of the launch plane [m^2].
Complex phase_integral(const Footprint& f, double k, const ConvexPolygon& polygon);

/// That integral at all wavenumbers of a band; of many, a few are computed and the others interpolated, to 1e-12 of the polygon's
/// area.
void phase_integrals(const Footprint& f, Band& band, const ConvexPolygon& polygon, std::vector<Complex>& integrals);

}  // namespace raytube
