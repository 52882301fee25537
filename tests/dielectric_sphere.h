// Exact series of a sphere of one medium, to compare with.
#pragma once

#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "core/field.h"

namespace raytube {

/// Logarithmic derivatives psi_n' / psi_n of orders up to `orders`, downward from where the start has been forgotten (Bohren &
/// Huffman 1983, equation 4.89).
inline std::vector<Complex> psi_slopes(Complex z, int orders) {
  const int beyond = std::max(orders, static_cast<int>(std::abs(z))) + 40;
  std::vector<Complex> slopes(static_cast<std::size_t>(beyond) + 1);
  for (int n = beyond; n > 0; --n) {
    const Complex ratio = static_cast<double>(n) / z;
    slopes[static_cast<std::size_t>(n) - 1] = ratio - 1.0 / (slopes[static_cast<std::size_t>(n)] + ratio);
  }
  return slopes;
}

/// |S| [m] of a sphere with E across and in the plane of scattering, `gamma` [rad] between the directions to transmitter and
/// receiver (Bohren & Huffman 1983, equations 4.74 and 4.88; magnitudes are the same in both conventions of time).
inline std::pair<double, double> dielectric_sphere(double radius, Complex permittivity, double k, double gamma) {
  const double x = k * radius, mu = -std::cos(gamma);
  const Complex m = std::sqrt(std::conj(permittivity));
  const int orders = static_cast<int>(x + 4.05 * std::cbrt(x) + 12.0);
  const std::vector<Complex> slopes = psi_slopes(m * x, orders);
  double psi_before = std::cos(x), psi = std::sin(x), chi_before = -std::sin(x), chi = std::cos(x), pi_before = 0.0, pi_n = 1.0;
  Complex across = 0.0, in = 0.0;
  for (int n = 1; n <= orders; ++n) {
    const double psi_n = (2 * n - 1) / x * psi - psi_before, chi_n = (2 * n - 1) / x * chi - chi_before;
    const Complex xi_n(psi_n, -chi_n), xi(psi, -chi), slope = slopes[static_cast<std::size_t>(n)];
    const Complex tm = slope / m + n / x, te = slope * m + n / x;
    const Complex a = (tm * psi_n - psi) / (tm * xi_n - xi), b = (te * psi_n - psi) / (te * xi_n - xi);
    const double tau = n * mu * pi_n - (n + 1) * pi_before, factor = (2.0 * n + 1.0) / (n * (n + 1.0));
    across += factor * (a * pi_n + b * tau), in += factor * (a * tau + b * pi_n);
    pi_before = std::exchange(pi_n, ((2 * n + 1) * mu * pi_n - (n + 1) * pi_before) / n);
    psi_before = std::exchange(psi, psi_n), chi_before = std::exchange(chi, chi_n);
  }
  return {std::abs(across) / k, std::abs(in) / k};
}

}  // namespace raytube
