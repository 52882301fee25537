// Closed forms and exact series the tests compare with.
#pragma once

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/field.h"

namespace raytube::closed_forms {

/// Monostatic physical optics of a square plate of side a in z = 0 turned by `turn` (Knott, Shaeffer & Tuley 2004, ch. 5).
inline Complex plate(double a, double k, const Direction& look, double turn = 0.0) {
  const double s = std::sin(look.theta), phi = look.phi - turn;
  return Complex(0.0, -a * a * k / (2.0 * pi) * std::abs(std::cos(look.theta)) * sinc(k * a * s * std::cos(phi)) *
                          sinc(k * a * s * std::sin(phi)));
}

/// Dihedral with faces w x b on +x and +y at elevation 0, azimuth g: both single bounces and the double bounce, all radiating.
/// sign -1 for V (E along the fold), +1 for H.
inline Complex dihedral(double w, double b, double k, double g, int sign) {
  const double s = std::sin(g), c = std::cos(g);
  const Complex single =
      w * s * sinc(k * w * c) * std::polar(1.0, k * w * c) + w * c * sinc(k * w * s) * std::polar(1.0, k * w * s);
  return Complex(0.0, -b * k / (2.0 * pi)) * (single + sign * 2.0 * w * std::min(s, c));
}

/// What an antenna at this distance from the middle of a sphere makes of the partial wave n of a plane wave. It is a Huygens
/// source that looks there, an electric and a magnetic dipole: (1 + cos) / 2 about its axis, with the polarisations of a plane
/// wave carried along. On the axis a dipole's own partial waves are h_n(kr) and (kr h_n(kr))' / kr (Tai 1994, Dyadic Green
/// Functions, section 10-2), so that both kinds, TE and TM, have the mean of the two, which far away are as large.
inline Complex huygens_source(int n, double distance, double k) {
  if (std::isinf(distance)) return 1.0;
  const double x = k * distance;
  Complex before = Complex(0, 1) / x, h = (Complex(0, 1) / x - 1.0) / x;  // h_n^(2)(x) e^{jx}, upwards
  for (int i = 1; i < n; ++i) before = std::exchange(h, (2.0 * i + 1.0) / x * h - before);
  return 0.5 * x * (h + Complex(0, 1) * (before - n / x * h)) * std::polar(1.0, -0.5 * pi * ((n + 1) % 4));
}

/// Perfectly conducting sphere of radius a, phase reference at its centre; `gamma` is the angle between the directions to
/// transmitter and receiver (0 backscatter). First: E in the scattering plane, second: E across it, each referred to
/// basis vectors that coincide for gamma = 0. Exact series (Bohren & Huffman 1983, section 4.4, with e^{+j omega t}), of plane
/// waves or of Huygens sources at a distance, one of them the receiver (reciprocity).
inline std::pair<Complex, Complex> sphere(double a, double k, double gamma,
                                          double transmit_range = std::numeric_limits<double>::infinity(),
                                          double receive_range = std::numeric_limits<double>::infinity()) {
  const double x = k * a, u = -std::cos(gamma);  // cosine of the scattering angle from forward
  const int terms = static_cast<int>(x + 4.0 * std::cbrt(x) + 20.0);
  Complex in_plane = 0.0, across = 0.0;
  double pi_before = 0.0, pi_now = 1.0;
  for (int n = 1; n <= terms; ++n) {
    const unsigned order = static_cast<unsigned>(n);
    const double j = std::sph_bessel(order, x), j_before = std::sph_bessel(order - 1, x);
    const Complex h(j, -std::sph_neumann(order, x)), h_before(j_before, -std::sph_neumann(order - 1, x));
    const Complex an = (x * j_before - n * j) / (x * h_before - double(n) * h), bn = j / h;
    const double tau = n * u * pi_now - (n + 1) * pi_before;
    const Complex weight =
        (2.0 * n + 1.0) / (n * (n + 1.0)) * huygens_source(n, transmit_range, k) * huygens_source(n, receive_range, k);
    in_plane += weight * (an * tau + bn * pi_now);
    across += weight * (an * pi_now + bn * tau);
    const double pi_next = ((2.0 * n + 1.0) * u * pi_now - (n + 1.0) * pi_before) / n;
    pi_before = pi_now;
    pi_now = pi_next;
  }
  const Complex scale = 1.0 / Complex(0.0, k);
  return {-scale * in_plane, scale * across};
}

}  // namespace raytube::closed_forms
