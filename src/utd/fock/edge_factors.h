// How a curved face changes the current that an edge sends over it (Pathak 1979, Radio Sci. 14, 419: surface-to-surface
// functions).
#pragma once

#include "core/field.h"

namespace raytube {

/// The factors at the distance xi from the edge along a geodesic, xi = integral (k kappa^2 / 2)^(1/3) ds: the current of a flat
/// face times
///   hard (H along the binormal)  v(xi) = e^{-j pi/4} sqrt(pi xi) sum e^{-j xi t'_n e^{-j pi/3}} / (t'_n e^{-j pi/3}),
///   soft (E along it)            u(xi) = 2 e^{j pi/4} sqrt(pi) xi^{3/2} sum e^{-j xi t_n e^{-j pi/3}},
/// Ai'(-t'_n) = Ai(-t_n) = 0; both are 1 on a flat face. Error 1e-5; none is left beyond xi = 20.
struct EdgeFactors {
  Complex hard, soft;
};
EdgeFactors edge_factors(double xi);

}  // namespace raytube
