// Wiener-Hopf factors. Notation in sheet_admittance.h; here sin_cone is 1: what a cone changes goes into the coefficients.
#pragma once

#include <optional>
#include <vector>

#include "core/field.h"

namespace raytube {

inline constexpr Complex imaginary_unit(0.0, 1.0);  // j

/// Which of the two scalar problems.
enum class SheetChannel { curl, divergence };

/// (1 - a^2)^{1/2}, 1 at a = 0 and -j times a positive number on the real axis beyond 1; cut from 1 along -j e^{-j tilt}.
Complex sheet_root(Complex a, double tilt = 0.0);

/// Q = 2 s + y (curl) or 2 + s y (divergence), y = constant + quadratic a^2, as P(a) P(-a) with P regular and without zeros for
/// Re a > 0:
///   ln P(a) = (a/pi) integral over t from 0 of ln Q(jt) dt / (t^2 + a^2),
/// on the imaginary axis, where neither branch points nor poles are near (Noble 1958, section 1.3; Senior & Volakis 1995, chapter
/// 3). 1e-9 for coefficients of passive layers.
class SplitFunction {
 public:
  SplitFunction(SheetChannel channel, Complex constant, Complex quadratic);

  Complex admittance(Complex a) const { return constant_ + quadratic_ * a * a; }

  /// Z(a) = (1 + a)^{1/2} / P(a) (curl) or 1 / P(a): Z(a) Z(-a) is s / Q or 1 / Q.
  Complex at(Complex a) const;

  /// The guided waves: roots a of Q on the proper sheet, Re a > 0, of a cut tilted like that; |a| below `slowest`.
  std::vector<Complex> guided(double slowest, double tilt) const;

  /// Q at the given s.
  Complex kernel(Complex s, Complex a) const;
  /// What s / Q or 1 / Q has at a guided wave: its residue.
  Complex residue(Complex a, double tilt) const;
  /// s / Q or 1 / Q on one side of the cut less that on the other one.
  Complex jump(Complex a) const;

 private:
  Complex logarithm(Complex a) const;
  Complex logarithm_near(Complex a) const;

  SheetChannel channel_;
  Complex constant_, quadratic_;
  // At the nodes t of the imaginary axis: t^2, weight of the rule, and ln Q without jumps.
  std::vector<double> node_, weight_, real_, imaginary_;
};

}  // namespace raytube
