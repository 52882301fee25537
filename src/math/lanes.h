// Elementary functions of a few numbers at a time, written as loops that the compiler turns into vector instructions. Only
// operations that IEEE 754 rounds correctly, so a value depends neither on its neighbours nor on the vector width.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/field.h"

namespace raytube {

inline constexpr std::size_t lanes = 8;

// Not 64: GCC 12 aligns a caller's temporaries to 32 all the same, where code for AVX-512 would rely on it.
struct alignas(32) Reals {
  double value[lanes];
  double& operator[](std::size_t i) { return value[i]; }
  double operator[](std::size_t i) const { return value[i]; }
};

struct Complexes {
  Reals re, im;
  Complex operator[](std::size_t i) const { return {re[i], im[i]}; }
  void set(std::size_t i, Complex value) {
    re[i] = value.real();
    im[i] = value.imag();
  }
};

/// Sum of coefficients[first + 2m] x^m.
template <std::size_t first, std::size_t count>
[[gnu::always_inline]] inline double every_second(const std::array<double, count>& coefficients, double x) {
  constexpr std::size_t last = (count - 1 - first) / 2;
  double sum = coefficients[first + 2 * last];
  [&]<std::size_t... m>(std::index_sequence<m...>) { ((sum = std::fma(sum, x, coefficients[first + 2 * (last - 1 - m)])), ...); }
  (std::make_index_sequence<last>{});
  return sum;
}

/// Sum of coefficients[m] x^m; even and odd powers apart, so that two chains of operations run side by side.
template <std::size_t count>
[[gnu::always_inline]] inline double polynomial(const std::array<double, count>& coefficients, double x) {
  return std::fma(every_second<1>(coefficients, x * x), x, every_second<0>(coefficients, x * x));
}

/// e^{j angle}; absolute error below 3e-16 for |angle| < 1e9, of the angle as given.
Complexes unit_phasors(const Reals& angle);

/// sin(x)/x, 1 at x = 0; relative error below 1e-15 but for the last places of |x| > 1e9.
Reals sincs(const Reals& x);

/// 1 - e^{-x}, x >= 0; relative error below 3e-16.
Reals one_minus_exp(const Reals& x);

}  // namespace raytube
