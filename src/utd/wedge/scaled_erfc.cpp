#include "utd/wedge/scaled_erfc.h"

#include <algorithm>

#include "math/erfc_ray.h"

namespace raytube {

namespace {

// Kouyoumjian and Pathak (1974), Proc. IEEE 62, 1448: X and F(X), linear in between.
constexpr std::array<double, 8> nodes = {0.3, 0.5, 0.7, 1.0, 1.5, 2.3, 4.0, 5.5};
constexpr std::array<double, 8> table_re = {0.5729, 0.6768, 0.7439, 0.8095, 0.873, 0.9240, 0.9658, 0.9797};
constexpr std::array<double, 8> table_im = {0.2677, 0.2682, 0.2549, 0.2322, 0.1982, 0.1577, 0.1073, 0.0828};

// Every interval of the table adds the part of its rise that lies below X, (|X - low| - |X - high| + high - low) / 2 of its
// width.
Complexes table_at(const Reals& x) {
  Complexes f;
  for (std::size_t i = 0; i < lanes; ++i) f.set(i, {table_re[0], table_im[0]});
  for (std::size_t node = 1; node < nodes.size(); ++node) {
    const double low = nodes[node - 1], high = nodes[node], width = high - low;
    const double rise_re = (table_re[node] - table_re[node - 1]) / (2 * width);
    const double rise_im = (table_im[node] - table_im[node - 1]) / (2 * width);
    for (std::size_t i = 0; i < lanes; ++i) {
      const double below = std::abs(x[i] - low) - std::abs(x[i] - high) + width;
      f.re[i] += rise_re * below;
      f.im[i] += rise_im * below;
    }
  }
  return f;
}

// 1 + j/(2X) - 3/(4X^2) - j 15/(8X^3) + 75/(16X^4); the last coefficient is printed so, the series itself has 105/16.
Complexes series_at(const Reals& x) {
  Complexes f;
  for (std::size_t i = 0; i < lanes; ++i) {
    const double inverse = 1 / x[i], squared = inverse * inverse;
    f.re[i] = 1 + squared * (-3.0 / 4 + squared * (75.0 / 16));
    f.im[i] = inverse * (1.0 / 2 - squared * (15.0 / 8));
  }
  return f;
}

// Both ranges of F from the first node on, as W: divided by sqrt(pi) e^{j pi/4} x.
Complexes from_first_node(const Reals& x, const Reals& squared) {
  const Complexes table = table_at(squared), series = series_at(squared);
  Complexes w;
  for (std::size_t i = 0; i < lanes; ++i) {
    const bool far = squared[i] > nodes.back();
    const double scale = std::numbers::inv_sqrtpi / (std::numbers::sqrt2 * x[i]);
    const double re = far ? series.re[i] : table.re[i], im = far ? series.im[i] : table.im[i];
    w.re[i] = scale * (re + im);
    w.im[i] = scale * (im - re);
  }
  return w;
}

// F ~ [sqrt(pi X) - 2X e^{j pi/4} - (2/3) X^2 e^{-j pi/4}] e^{j(pi/4 + X)}, without the factor x.
Complexes small_argument(const Reals& x, const Reals& squared) {
  Complexes w = unit_phasors(squared);
  constexpr double scale = std::numbers::sqrt2 * std::numbers::inv_sqrtpi;
  for (std::size_t i = 0; i < lanes; ++i) {
    const double third = squared[i] / 3, re = 1 - scale * x[i] * (1 + third), im = -scale * x[i] * (1 - third);
    const double turn = w.re[i];
    w.re[i] = turn * re - w.im[i] * im;
    w.im[i] = turn * im + w.im[i] * re;
  }
  return w;
}

// The misprint: [sqrt(pi X) - 2X e^{-j pi/4} - (2/3) X^2 e^{-j pi/4}] e^{-j pi/4 + X}.
Complexes small_argument_as_printed(const Reals& x, const Reals& squared) {
  Complexes w;
  const Reals fallen = one_minus_exp(squared);
  constexpr double scale = std::numbers::sqrt2 * std::numbers::inv_sqrtpi;
  for (std::size_t i = 0; i < lanes; ++i) {
    const double risen = 1 / (1 - fallen[i]), slope = scale * x[i] * (1 + squared[i] / 3);
    w.re[i] = risen * slope;
    w.im[i] = risen * (slope - 1);
  }
  return w;
}

template <class SmallArgument>
Complexes three_ranges(const Reals& x, SmallArgument small_argument_form) {
  Reals squared, small;
  for (std::size_t i = 0; i < lanes; ++i) {
    squared[i] = x[i] * x[i];
    small[i] = std::min(squared[i], nodes.front());
  }
  const Complexes near = small_argument_form(x, small);
  Complexes w = from_first_node(x, squared);
  for (std::size_t i = 0; i < lanes; ++i) {
    const bool is_small = squared[i] < nodes.front();
    w.re[i] = is_small ? near.re[i] : w.re[i];
    w.im[i] = is_small ? near.im[i] : w.im[i];
  }
  return w;
}

Complexes kouyoumjian_pathak(const Reals& x) { return three_ranges(x, small_argument); }
Complexes as_printed(const Reals& x) { return three_ranges(x, small_argument_as_printed); }

}  // namespace

ScaledErfc scaled_erfc_of(TransitionTier tier) {
  if (tier == TransitionTier::kouyoumjian_pathak) return kouyoumjian_pathak;
  if (tier == TransitionTier::as_printed) return as_printed;
  return scaled_erfc;
}

}  // namespace raytube
