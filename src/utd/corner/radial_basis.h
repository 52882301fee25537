// Sums over the orders nu of a corner's field, for many point sources on the unit sphere.
#pragma once

#include <array>
#include <vector>

#include "utd/corner/radial_wave.h"

namespace raytube {

/// The Green's functions of all nodes_over_orders(), and a few real functions of which all of them are sums: they are analytic in
/// the order and the angle, so what a number of functions leaves of them falls faster than exponentially; these leave 1e-13.
class RadialBasis {
 public:
  static constexpr int functions = 32;
  using PerFunction = std::array<double, functions>;

  /// The only one, made when it is first asked for. Thread-safe.
  static const RadialBasis& of_all_orders();

  /// [order]
  const RadialWave& wave(std::size_t order) const { return waves_[order]; }

  /// Of each function, the derivatives to c = cos(theta).
  struct Slopes {
    PerFunction slope, bend;
  };
  /// At -1 <= c < 1.
  Slopes at(double cosine) const;

  /// Factors of the functions in a sum, real and imaginary parts.
  using Factors = std::array<PerFunction, 2>;
  /// Those of the Green's function of an order.
  const Factors& factors(std::size_t order) const { return factors_[order]; }

 private:
  using Polynomials = std::array<PerFunction, RadialWave::terms>;  // [power][function]
  RadialBasis();

  std::vector<RadialWave> waves_;
  std::vector<Factors> factors_;
  std::array<std::array<Polynomials, RadialWave::polynomials>, 3> polynomials_;  // [derivative]
};

/// A sum of the Green's functions of all orders, each with its own factor.
class RadialSum {
 public:
  /// *this += factor times that of this order.
  void add(Complex factor, std::size_t order);

  /// Its derivatives, from those of the functions at an angle.
  Complex slope(const RadialBasis::Slopes& at) const { return times(at.slope); }
  Complex bend(const RadialBasis::Slopes& at) const { return times(at.bend); }

 private:
  Complex times(const RadialBasis::PerFunction& values) const;

  RadialBasis::Factors factors_{};
};

}  // namespace raytube
