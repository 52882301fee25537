// The complementary error function on the diagonal of the complex plane, where every transition of an edge current lives.
#pragma once

#include "field.h"

namespace raytube {

/// W(x) = e^{z^2} erfc(z) at z = e^{j pi/4} x, x >= 0; W(x) = w(jz), and F(x^2) = sqrt(pi) z W(x) is the transition function.
/// Absolute error below 3e-15. Piecewise polynomials fitted once to faddeeva(); about 20 multiplications a value.
Complex scaled_erfc(double x);

/// erf(z)/x, entire in x: its value at 0 is 2 e^{j pi/4} / sqrt(pi). `value` is W(x) and `decay` e^{-z^2} = e^{-jx^2}.
Complex erf_over(double x, Complex value, Complex decay);

/// (W(a) - W(b)) / (a - b), W'(a) where a = b; `at_a`, `at_b` are the two values.
Complex divided_difference(double a, double b, Complex at_a, Complex at_b);

}  // namespace raytube
