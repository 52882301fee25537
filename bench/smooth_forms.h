// Physical optics of smooth bodies in closed form: what the facets of their meshes stand for.
#pragma once

#include <cmath>

#include "core/field.h"

namespace raytube::bench {

/// Monostatic physical optics of the lit half of a sphere of radius a, phase reference at its centre: the integral of u e^{2jkau}
/// over u = cos(theta) from 0 to 1 (Knott, Shaeffer & Tuley 2004, ch. 5).
inline Complex sphere_po(double a, double k) {
  const Complex jc(0.0, 2.0 * k * a);
  return Complex(0.0, -k * a * a) * (std::exp(jc) / jc - (std::exp(jc) - 1.0) / (jc * jc));
}

/// The same for a closed cylinder of radius a and length b along z, centred, seen at angle `theta` from its axis: lit half of the
/// side (an integral over its azimuth, by Simpson's rule) and lit cap.
inline Complex cylinder_po(double a, double b, double k, double theta) {
  const double s = std::sin(theta), c = std::cos(theta), x = 2.0 * k * a * s;
  constexpr int panels = 2000;
  Complex side = 0.0;
  for (int i = 0; i <= panels; ++i) {
    const double phi = pi * (double(i) / panels - 0.5), weight = i == 0 || i == panels ? 1.0 : i % 2 ? 4.0 : 2.0;
    side += weight * std::polar(std::cos(phi), x * std::cos(phi));
  }
  side *= a * b * s * sinc(k * b * c) * pi / (3.0 * panels);
  const double cap = pi * a * a * std::abs(c) * (x == 0.0 ? 1.0 : 2.0 * std::cyl_bessel_j(1.0, x) / x);
  return Complex(0.0, -k / (2.0 * pi)) * (side + std::polar(cap, k * b * std::abs(c)));
}

}  // namespace raytube::bench
