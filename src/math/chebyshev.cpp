#include "math/chebyshev.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

// Half the width of a band over its middle below which rounding puts nodes on one another.
constexpr double narrowest = 1e-12;

// e^{jzx} on |x| <= 1 is the sum of 2 j^n J_n(z) T_n(x) (DLMF 10.12), and |J_n(z)| <= (z/2)^n / n! (DLMF 10.14.4). `count` nodes
// leave an error of four times the terms from n = count on. Rounded up to a multiple of four, so that few different sets are
// needed.
std::size_t nodes_needed(double z, std::size_t limit) {
  double bound = 1.0;
  std::size_t count = 0;
  while (bound > 1e-13 && count <= limit) bound *= 0.5 * z / static_cast<double>(++count);
  return std::max<std::size_t>(4, (count + 3) / 4 * 4);
}

// Barycentric formula (Berrut & Trefethen, SIAM Review 46, 2004, eq. 4.2) with the weights of the first kind (eq. 5.3).
ChebyshevNodes make_nodes(std::size_t count, double middle, double half_width, std::span<const double> wavenumbers) {
  ChebyshevNodes nodes;
  std::vector<double> barycentric(count);
  for (std::size_t n = 0; n < count; ++n) {
    const double angle = (2.0 * static_cast<double>(n) + 1.0) * pi / (2.0 * static_cast<double>(count));
    nodes.at.push_back(middle + half_width * std::cos(angle));
    barycentric[n] = (n % 2 == 0 ? 1.0 : -1.0) * std::sin(angle);
  }
  for (const double k : wavenumbers) {
    std::vector<double> row(count);
    if (const auto met = std::ranges::find(nodes.at, k); met != nodes.at.end())
      row[static_cast<std::size_t>(met - nodes.at.begin())] = 1.0;
    else
      for (std::size_t n = 0; n < count; ++n) row[n] = barycentric[n] / (k - nodes.at[n]);
    double sum = 0.0;
    for (const double weight : row) sum += weight;
    for (const double weight : row) nodes.weights.push_back(weight / sum);
  }
  return nodes;
}

}  // namespace

Band::Band(std::span<const double> wavenumbers) : wavenumbers_(wavenumbers.begin(), wavenumbers.end()) {
  if (wavenumbers_.empty()) return;
  const auto [low, high] = std::ranges::minmax(wavenumbers_);
  middle_ = 0.5 * (low + high);
  half_width_ = 0.5 * (high - low);
  most_ = half_width_ > narrowest * middle_ ? wavenumbers_.size() / 2 : 0;
  // One over the sum of the half axes of the ellipse with its foci at the ends of the band that runs through k = 0 (Trefethen,
  // Approximation Theory and Approximation Practice, 2013, theorem 8.1).
  rate_ = half_width_ / (middle_ + std::sqrt(low * high));
}

const ChebyshevNodes* Band::nodes(double half_span) {
  const std::size_t count = nodes_needed(half_width_ * half_span, most_);
  return count > most_ ? nullptr : nodes_of_count(count);
}

// The terms from n = count on of a phase's series (nodes_needed) times one whose coefficients fall by `rate`: their product's are
// at most the sum of (z/2)^m / m! rate^(n - m).
const ChebyshevNodes* Band::nodes_of_fresnel(double half_span, double error) {
  const double half = 0.5 * half_width_ * half_span;
  double phase = 1.0, bound = 1.0;
  std::size_t count = 0;
  for (; 4.0 * bound > error && count <= most_; bound = rate_ * bound + phase) phase *= half / static_cast<double>(++count);
  return count > most_ ? nullptr : nodes_of_count(count);
}

const ChebyshevNodes* Band::nodes_of_count(std::size_t count) {
  const auto [entry, is_new] = nodes_.try_emplace(count);
  if (is_new) entry->second = make_nodes(count, middle_, half_width_, wavenumbers_);
  return &entry->second;
}

// Coefficients of an amplitude fall as rate^n, those of e^{jkx} as (z/2)^n / n!; with z = 2c rate those of the product from n = N
// on are rate^N (1 + c + c^2/2 + ...) < rate^N e^c. As rate = half_width / (2 k), k the mean wavenumber, |x| <= c / k.
Band::SlowNodes Band::slow_nodes(double least, double error) {
  if (most_ == 0) return {};
  const double count = std::max(std::ceil((std::log(error) - least) / std::log(rate_)), 2.0);
  if (!(count <= static_cast<double>(most_))) return {};
  const double reach = std::log(error) - count * std::log(rate_);
  return {nodes_of_count(static_cast<std::size_t>(count)), 2.0 * reach * rate_ / half_width_};
}

}  // namespace raytube
