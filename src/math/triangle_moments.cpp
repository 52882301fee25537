#include "math/triangle_moments.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace raytube {

namespace {

constexpr std::size_t most_nodes = 5;

// sum_p h_p(j y) / (n + p)! times e^{j mean}, y = x - mean. With |y| below 1 the terms left out add up to less than 1e-17.
Complex series(std::span<const double> x) {
  constexpr std::size_t terms = 16;
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
  std::array<double, terms> h{1.0};
  for (const double node : x)
    for (std::size_t p = 1; p < terms; ++p) h[p] += (node - mean) * h[p - 1];
  double factor = 1.0;
  for (std::size_t i = 2; i < x.size(); ++i) factor /= static_cast<double>(i);
  std::array<double, 2> parts{};  // real and imaginary
  for (std::size_t p = 0; p < terms; ++p) {
    parts[p % 2] += (p % 4 < 2 ? factor : -factor) * h[p];
    factor /= static_cast<double>(x.size() + p);
  }
  return std::polar(1.0, mean) * Complex(parts[0], parts[1]);
}

}  // namespace

Complex phasor_difference(std::span<const double> x) {
  assert(!x.empty() && x.size() <= most_nodes);
  constexpr double spread = 1.5;
  std::array<Complex, most_nodes> differences;
  for (std::size_t i = 0; i < x.size(); ++i) differences[i] = std::polar(1.0, x[i]);
  for (std::size_t order = 1; order < x.size(); ++order)
    for (std::size_t i = 0; i + order < x.size(); ++i) {
      const double step = x[i + order] - x[i];
      differences[i] =
          step < spread ? series(x.subspan(i, order + 1)) : (differences[i + 1] - differences[i]) / Complex(0.0, step);
    }
  return differences[0];
}

std::array<Complex, 6> triangle_moments(const std::array<double, 3>& x) {
  const auto moment = [&](int i, int j) {
    std::array<double, 5> nodes{x[0], x[1], x[2], x[i], x[j]};
    std::ranges::sort(nodes);
    return (i == j ? 4.0 : 2.0) * phasor_difference(nodes);
  };
  return {moment(0, 0), moment(1, 1), moment(2, 2), moment(0, 1), moment(1, 2), moment(2, 0)};
}

}  // namespace raytube
