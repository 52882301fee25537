// Fields of a point source on the unit sphere, as functions of the angle from it.
#pragma once

#include <array>
#include <vector>

#include "core/field.h"

namespace raytube {

/// psi(z), the logarithmic derivative of the gamma function, for Re z > 0 (Abramowitz & Stegun 1964, 6.3.5 and 6.3.18).
Complex digamma(Complex z);

/// A sum of Green's functions g of -Laplacian + 1/4 - nu^2 on the unit sphere, each with its own order nu and factor, as
/// polynomials over zones of the angle theta from the source. g = P_{nu-1/2}(-cos theta) / (4 cos(pi nu)) (Smyshlyaev 1993,
/// Wave Motion 18, 171). Relative accuracy 1e-8 for |nu| up to 17.
class RadialWave {
 public:
  /// With its derivatives to c = cos(theta).
  struct Values {
    Complex value, slope, bend;
  };

  /// Zero.
  RadialWave();
  /// Green's function of order `nu`, no half of an odd number.
  explicit RadialWave(Complex nu);

  /// *this += factor other.
  void add(Complex factor, const RadialWave& other);

  /// At -1 <= c < 1.
  Values at(double cosine) const;

  /// Beside the object itself.
  std::size_t zone_bytes() const { return zones_.size() * sizeof(Polynomial); }

  /// What is smooth of a single Green's function: g + ln(theta) / (2 pi) at the source.
  Complex smooth_at_source() const;

 private:
  static constexpr int terms = 14;
  using Polynomial = std::array<Complex, terms>;

  static Values evaluate(const Polynomial& p, double x);
  Values near_source(double cosine) const;

  std::vector<Polynomial> zones_;  // the first in 1 + c, all others in c less that of their middle
  Polynomial logarithmic_, rest_;  // around the source: logarithmic ln(t) + rest in t = (1 - c) / 2
};

}  // namespace raytube
