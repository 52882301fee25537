#include "math/triangle_moments.h"

#include <algorithm>
#include <cassert>

namespace raytube {

namespace {

using Counts = std::array<int, 3>;

constexpr std::size_t most_nodes = 5;
constexpr double spread = 1.5;  // of nodes that recursion takes apart

// Divided differences of exp at nodes j x, of which there are three that ascend, each as often as its count says. By recursion
// where they are spread, else by the series of complete homogeneous polynomials about the lowest (McCurdy, Ng & Parlett 1984,
// Math. Comp. 43, 501). What several have in common is found once.
class Differences {
 public:
  explicit Differences(const std::array<double, 3>& nodes) : x_(nodes) {
    for (std::size_t i = 0; i < 3; ++i) phasors_[i] = std::polar(1.0, x_[i]);
  }

  Complex of(const Counts& counts) {
    const auto slot = static_cast<std::size_t>(16 * counts[0] + 4 * counts[1] + counts[2]);
    if (!((found_ >> slot) & 1)) known_[slot] = find(counts), found_ |= std::uint64_t{1} << slot;
    return known_[slot];
  }

 private:
  Complex find(const Counts& counts) {
    const std::size_t low = counts[0] > 0 ? 0 : counts[1] > 0 ? 1 : 2, high = counts[2] > 0 ? 2 : counts[1] > 0 ? 1 : 0;
    if (low == high) {
      constexpr std::array factorials{1.0, 1.0, 2.0};
      return phasors_[low] / factorials[static_cast<std::size_t>(counts[low]) - 1];
    }
    const double step = x_[high] - x_[low];
    if (step < spread) return series(counts);
    Counts without_low = counts, without_high = counts;
    --without_low[low], --without_high[high];
    return times_minus_j(of(without_low) - of(without_high)) / step;
  }

  static Complex times_minus_j(const Complex& z) { return {z.imag(), -z.real()}; }

  // sum_p h_p(j y) / (n + p)! times e^{j lowest}, y = x - lowest. With y below 1.5 the terms left out add up to less than 1e-16.
  Complex series(const Counts& counts) const {
    constexpr std::size_t terms = 20;
    const std::size_t low = counts[0] > 0 ? 0 : 1;
    std::array<double, most_nodes> y{};
    std::size_t n = 0;
    for (std::size_t i = low; i < 3; ++i)
      for (int c = 0; c < counts[i]; ++c) y[n++] = x_[i] - x_[low];
    double factor = 1.0;
    for (std::size_t i = 2; i < n; ++i) factor /= static_cast<double>(i);
    std::array<double, most_nodes> h;  // h_p of the first 1, 2, ... nodes
    h.fill(1.0);
    std::array<double, 2> parts{};  // real and imaginary
    for (std::size_t p = 0; p < terms; ++p) {
      parts[p % 2] += (p % 4 < 2 ? factor : -factor) * h[n - 1];
      factor /= static_cast<double>(n + p);
      double before = 0.0;
      for (std::size_t i = 0; i < n; ++i) before = h[i] = before + y[i] * h[i];
    }
    return phasors_[low] * Complex(parts[0], parts[1]);
  }

  std::array<double, 3> x_;
  std::array<Complex, 3> phasors_;
  std::array<Complex, 64> known_;
  std::uint64_t found_ = 0;  // bit by bit: which of `known_` are
};

}  // namespace

std::array<Complex, 6> triangle_moments(const std::array<double, 3>& x) {
  std::array<std::size_t, 3> order{0, 1, 2};
  std::ranges::sort(order, {}, [&](std::size_t i) { return x[i]; });
  std::array<std::size_t, 3> place{};  // of a corner among the nodes
  for (std::size_t i = 0; i < 3; ++i) place[order[i]] = i;
  Differences differences({x[order[0]], x[order[1]], x[order[2]]});
  const auto moment = [&](std::size_t i, std::size_t j) {
    Counts counts{1, 1, 1};
    ++counts[place[i]], ++counts[place[j]];
    return (i == j ? 4.0 : 2.0) * differences.of(counts);
  };
  return {moment(0, 0), moment(1, 1), moment(2, 2), moment(0, 1), moment(1, 2), moment(2, 0)};
}

}  // namespace raytube
