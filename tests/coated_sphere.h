// Exact series of a coated sphere, to compare with.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "scene/layers.h"

namespace raytube {

// In long double: its exponents hold products of growing and decaying waves up to |Im z| of some 5000.
class RiccatiBessel {
 public:
  using Fine = std::complex<long double>;

  // Of order n at z, Im z <= 0: psi = z j_n and xi = z h_n^(2), the wave that goes outwards.
  struct Order {
    Fine psi_slope, xi_slope;  // logarithmic derivatives psi'/psi and xi'/xi
    Fine ratio;                // psi/xi
  };

  RiccatiBessel(Fine z, int orders) : orders_(static_cast<std::size_t>(orders) + 1) {
    fill_psi_slopes(z);
    // psi_0 = sin z, xi_0 = j e^{-jz}. Upward, as xi grows with the order (Bohren & Huffman 1983, section 4.8).
    orders_[0].xi_slope = Fine(0.0L, -1.0L);
    orders_[0].ratio = 0.5L * (1.0L - std::exp(Fine(0.0L, 2.0L) * z));
    for (std::size_t n = 1; n < orders_.size(); ++n) {
      const Fine n_over_z = static_cast<long double>(n) / z;
      orders_[n].xi_slope = 1.0L / (n_over_z - orders_[n - 1].xi_slope) - n_over_z;
      // From psi_{n-1} = (n/z) psi_n + psi_n', and the same of xi.
      orders_[n].ratio = orders_[n - 1].ratio * (orders_[n].xi_slope + n_over_z) / (orders_[n].psi_slope + n_over_z);
    }
  }

  const Order& operator[](int n) const { return orders_[static_cast<std::size_t>(n)]; }

 private:
  // Downward from an order where the start has been forgotten (Bohren & Huffman 1983, equation 4.89).
  void fill_psi_slopes(Fine z) {
    const long double size = std::abs(z);
    const auto beyond = static_cast<std::size_t>(size + 10.0L * std::cbrt(size) + 60.0L);
    Fine slope = 0.0L;
    for (std::size_t n = std::max(orders_.size(), beyond); n > 0; --n) {
      if (n < orders_.size()) orders_[n].psi_slope = slope;
      const Fine n_over_z = static_cast<long double>(n) / z;
      slope = n_over_z - 1.0L / (slope + n_over_z);
    }
    orders_[0].psi_slope = slope;
  }

  std::vector<Order> orders_;
};

/// Coefficient of one partial wave. In the layer F = psi - A xi, where A makes F (TE) or F' (TM) vanish on the core; `mix` is
/// A xi / psi at the outer face, over which eta F' / F is continuous.
inline RiccatiBessel::Fine scattered(const RiccatiBessel::Order& vacuum, const RiccatiBessel::Order& layer,
                                     RiccatiBessel::Fine mix, RiccatiBessel::Fine eta) {
  const RiccatiBessel::Fine f = 1.0L - mix, slope = eta * (layer.psi_slope - mix * layer.xi_slope);
  return vacuum.ratio * (vacuum.psi_slope * f - slope) / (vacuum.xi_slope * f - slope);
}

/// Monostatic S of a perfectly conducting sphere under one layer, phase reference at its centre, VV for theta-hat; passive
/// medium, neither epsilon nor mu zero. Exact series (Aden & Kerker 1951; the core as in Ruck, Barrick, Stuart & Krichbaum 1970,
/// section 3.3), by logarithmic derivatives (Bohren & Huffman 1983, section 8.1).
inline Complex coated_sphere(double core_radius, const Layer& coat, double k) {
  using Fine = RiccatiBessel::Fine;
  const Fine mu = coat.medium.permeability, square = Fine(coat.medium.permittivity) * mu;
  Fine index = std::sqrt(square);
  if (index.imag() > 0.0L) index = -index;
  const Fine impedance = mu / index;
  const long double size = static_cast<long double>(k) * (core_radius + coat.thickness);
  const int terms = static_cast<int>(size + 4.0L * std::cbrt(size) + 30.0L);
  const RiccatiBessel vacuum(size, terms), outer(index * size, terms),
      inner(index * (static_cast<long double>(k) * core_radius), terms);
  Fine sum = 0.0L;
  for (int n = 1; n <= terms; ++n) {
    const Fine te = scattered(vacuum[n], outer[n], inner[n].ratio / outer[n].ratio, 1.0L / impedance),
               tm = scattered(vacuum[n], outer[n], inner[n].ratio / outer[n].ratio * inner[n].psi_slope / inner[n].xi_slope,
                              impedance);
    sum += static_cast<long double>(n % 2 ? -1 : 1) * (n + 0.5L) * (tm - te);
  }
  return Complex(sum * Fine(0.0L, 1.0L / k));
}

}  // namespace raytube
