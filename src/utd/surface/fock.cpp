#include "utd/surface/fock.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace raytube {

namespace {

// Polynomials of degree 8, highest power first, fitted to quadrature along the contour and, beyond xi = 1, to 60 residues.
using Polynomial = std::array<Complex, 9>;

// Of G e^{j tau_1 xi} and F e^{j t_1 xi} over 0 <= xi <= 4, in xi / 2 - 1.
const Polynomial hard_dark = {{{-0.026906, 0.0614973},
                               {-0.0419394, -0.0670333},
                               {0.138103, -0.129885},
                               {0.0386495, 0.236521},
                               {-0.262244, -0.0779548},
                               {0.224566, -0.101567},
                               {-0.0741807, 0.133696},
                               {-0.00508094, -0.0680416},
                               {1.84124, 0.0125944}}};
const Polynomial soft_dark = {{{-0.0616113, 0.0292733},
                               {0.00131393, -0.100451},
                               {0.221845, 0.0145326},
                               {-0.11095, 0.234841},
                               {-0.281558, -0.225648},
                               {0.402481, -0.0930209},
                               {-0.194243, 0.295569},
                               {-0.0105729, -0.205359},
                               {1.26989, -0.665202}}};
// Of G e^{-j xi^3/3} and F e^{-j xi^3/3} over -3 <= xi <= 0, in xi / 1.5 + 1.
const Polynomial hard_lit = {{{-0.0140848, 0.00108961},
                              {-0.0112975, 0.0219888},
                              {0.0437878, 0.0271091},
                              {0.0601815, -0.0485962},
                              {-0.0393444, -0.129861},
                              {-0.180922, -0.0967971},
                              {-0.237768, 0.0279544},
                              {-0.166997, 0.114515},
                              {1.94583, 0.0826597}}};
const Polynomial soft_lit = {{{0.00540516, -0.00331422},
                              {-0.000254055, -0.0117337},
                              {-0.0258313, -0.000671506},
                              {-0.0141152, 0.0458389},
                              {0.0729913, 0.0734525},
                              {0.183846, 0.0132018},
                              {0.227673, -0.118631},
                              {-2.8355, -0.213867},
                              {3.05765, -0.172208}}};

// The first zeros of Ai' and Ai, and how their creeping waves turn and fall.
constexpr double first_hard = 1.01879297, first_soft = 2.33810741;

Complex at(const Polynomial& polynomial, double x) {
  Complex sum = 0.0;
  for (const Complex& c : polynomial) sum = sum * x + c;
  return sum;
}

Complex creeping(double zero, double xi) { return std::exp(Complex(0, -zero * xi) * std::polar(1.0, -pi / 3)); }

}  // namespace

FockCurrents fock_in_the_dark(double xi) {
  const double x = std::min(xi, 4.0) / 2 - 1;
  return {at(hard_dark, x) * creeping(first_hard, xi), at(soft_dark, x) * creeping(first_soft, xi)};
}

void DarkWay::step(double curvature, double gaussian, double h) {
  constexpr double along_hard = first_hard * first_hard / 60 + 0.1 / first_hard, along_soft = first_soft * first_soft / 60;
  constexpr double across_hard = 0.25 / first_hard;
  if (curvature <= 0.0) return;
  const double turn = h * std::cbrt(2 * curvature);
  const double across = std::clamp(gaussian / curvature, -curvature, curvature);
  distance_ += h * std::cbrt(0.5 * curvature * curvature);
  hard_more_ += turn * (along_hard * curvature - across_hard * across);
  soft_more_ += turn * along_soft * curvature;
}

FockCurrents DarkWay::currents(double wavenumber) const {
  // Of the first order's exponent; so much the second has where it is no longer small beside the first.
  constexpr double most = 0.15;
  const double scale = 1.0 / std::cbrt(wavenumber), xi = distance(wavenumber);
  const auto factor = [&](double more, double zero) {
    const double all = std::max(most * zero * xi, 1e-30);
    return std::exp(-std::polar(scale * more / std::hypot(1.0, scale * more / all), -pi / 6));
  };
  const FockCurrents fock = fock_in_the_dark(xi);
  return {fock.hard * factor(hard_more_, first_hard), fock.soft * factor(soft_more_, first_soft)};
}

FockCurrents fock_factors(double xi) {
  if (xi < -3.0) {
    const Complex rest(0.0, 0.25 / (xi * xi * xi));
    return {1.0 - rest, 1.0 + rest};
  }
  const double x = xi / 1.5 + 1;
  return {0.5 * at(hard_lit, x), at(soft_lit, x) / (-2 * xi)};
}

}  // namespace raytube
