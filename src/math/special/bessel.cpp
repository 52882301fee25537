#include "math/special/bessel.h"

#include <cmath>

#include "math/special/elementary.h"
#include "math/gauss.h"

namespace raytube {

namespace {

constexpr double least_common = 2.0;  // from here on libstdc++ goes by recurrences and continued fractions (Temme, Steed)

template <class Function>
double integral(double begin, double end, const Function& f) {
  double sum = 0.0;
  for (const GaussPoint& point : gauss_rule(32)) sum += point.weight * f(begin + (end - begin) * point.node);
  return (end - begin) * sum;
}

}  // namespace

// DLMF 10.2.2, where libstdc++ has it, too: terms fall from the first on.
double bessel_j(double nu, double x) {
  if (x * x >= 10 * (nu + 1)) return std::cyl_bessel_j(nu, x);
  double term = std::pow(x / 2, nu) / gamma_function(nu + 1), sum = term;
  for (int k = 1; std::abs(term) > 1e-17 * std::abs(sum); ++k) sum += term *= -x * x / (4 * k * (k + nu));
  return sum;
}

// DLMF 10.9.7; the second integral is all there is to large orders, and of one sign.
double bessel_y(double nu, double x) {
  if (x >= least_common) return std::cyl_neumann(nu, x);
  const auto wave = [&](double t) { return std::sin(x * std::sin(t) - nu * t); };
  const double turn = std::cos(nu * pi);
  const auto fall = [&](double t) { return std::exp(nu * t - x * std::sinh(t)) + turn * std::exp(-nu * t - x * std::sinh(t)); };
  double sum = integral(0.0, pi / 2, wave) + integral(pi / 2, pi, wave);
  constexpr double step = 0.5, nothing = 50.0;  // e^-50 of the whole
  for (double t = 0.0; x * std::sinh(t) - nu * t < nothing; t += step) sum -= integral(t, t + step, fall);
  return sum / pi;
}

}  // namespace raytube
