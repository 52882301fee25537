// Fields of a point source on the unit sphere, as functions of the angle from it.
#pragma once

#include <array>

#include "core/field.h"

namespace raytube {

/// psi(z), the logarithmic derivative of the gamma function, for Re z > 0 (Abramowitz & Stegun 1964, 6.3.5 and 6.3.18).
Complex digamma(Complex z);

/// Green's function g of -Laplacian + 1/4 - nu^2 on the unit sphere, as polynomials over zones of the angle theta from the
/// source. g = P_{nu-1/2}(-cos theta) / (4 cos(pi nu)) (Smyshlyaev 1993, Wave Motion 18, 171). Relative accuracy 1e-8 for |nu| up
/// to 17.
class RadialWave {
 public:
  /// Of order `nu`, no half of an odd number.
  explicit RadialWave(Complex nu);

  /// With its derivatives to c = cos(theta).
  struct Values {
    Complex value, slope, bend;
  };
  /// At -1 <= c < 1.
  Values at(double cosine) const;

  /// What is smooth of it: g + ln(theta) / (2 pi) at the source.
  Complex smooth_at_source() const;

  static constexpr int terms = 14, zones = 34, polynomials = zones + 2;
  using Polynomial = std::array<Complex, terms>;
  /// The zones', the first in 1 + c, all others in c less that of their middle; around the source logarithmic and rest, of
  /// logarithmic ln(t) + rest in t = (1 - c) / 2.
  const std::array<Polynomial, polynomials>& coefficients() const { return coefficients_; }

  /// Where an angle lies: the polynomial, and its argument. Around the source the first one of two.
  struct Place {
    int polynomial;
    double x;
    bool near_source() const { return polynomial == logarithmic; }
  };
  static Place place(double cosine);
  /// The greatest |x| there.
  static double reach(int polynomial);

 private:
  static constexpr int logarithmic = zones, rest = zones + 1;

  std::array<Polynomial, polynomials> coefficients_;
};

}  // namespace raytube
