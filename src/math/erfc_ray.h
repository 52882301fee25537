// The complementary error function on the diagonal of the complex plane, where every transition of an edge current lives.
#pragma once

#include "math/lanes.h"

namespace raytube {

/// W(x) = e^{z^2} erfc(z) at z = e^{j pi/4} x, 0 <= x < 1e17; W(x) = w(jz) of the Faddeeva function, and sqrt(pi) z W(x) = F(x^2)
/// is the transition function. Error below 1e-15 / max(1, x). A rational function fitted by erfc_ray_fit.py.
Complexes scaled_erfc(const Reals& x);
Complex scaled_erfc(double x);

/// erf(z)/x, entire in x: its value at 0 is 2 e^{j pi/4} / sqrt(pi). `values` are W(x) and `decay` e^{-z^2} = e^{-jx^2}.
Complexes erf_over(const Reals& x, const Complexes& values, const Complexes& decay);

/// (W(a) - W(b)) / (a - b), W'(a) where a = b; `at_a`, `at_b` are the two values.
Complexes divided_difference(const Reals& a, const Reals& b, const Complexes& at_a, const Complexes& at_b);

/// Where the two quotients are close to 0/0 and are found as series of the exact W, whatever values were given.
bool is_removable(double x);
bool is_removable(double a, double b);

}  // namespace raytube
