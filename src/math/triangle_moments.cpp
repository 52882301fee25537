#include "math/triangle_moments.h"

#include <algorithm>

namespace raytube {

namespace {

constexpr double spread = 1.5;  // of nodes that recursion takes apart
constexpr std::size_t most_nodes = 5, terms = 20;
constexpr auto inverse_factorials = [] {
  std::array<double, most_nodes + terms> all{1.0};
  for (std::size_t n = 1; n < all.size(); ++n) all[n] = all[n - 1] / static_cast<double>(n);
  return all;
}();

using Counts = std::array<int, 3>;

// Divided differences of exp at nodes j x, of which there are three that ascend, each as often as its count says. By recursion
// where they are spread, else by the series of complete homogeneous polynomials about the lowest (McCurdy, Ng & Parlett 1984,
// Math. Comp. 43, 501).
class Differences {
 public:
  explicit Differences(const std::array<double, 3>& nodes) : x_(nodes) {
    for (std::size_t i = 0; i < 3; ++i) phasors_[i] = std::polar(1.0, x_[i]);
    if (is_close(0, 2)) return;
    lower_ = pairs(0), upper_ = pairs(1);
    for (std::size_t a = 1; a < 4; ++a)
      for (std::size_t b = 1; a + b < 5; ++b)
        for (std::size_t c = 1; a + b + c < 6; ++c)
          triples_[a][b][c] =
              quotient(a > 1 ? triples_[a - 1][b][c] : upper_[b][c], c > 1 ? triples_[a][b][c - 1] : lower_[a][b], x_[2] - x_[0]);
  }

  // Of all three, five nodes together.
  Complex of(const Counts& counts) const {
    return is_close(0, 2) ? series(counts) : triples_[std::size_t(counts[0])][std::size_t(counts[1])][std::size_t(counts[2])];
  }

 private:
  using Pairs = std::array<std::array<Complex, 4>, 4>;  // by both counts

  bool is_close(std::size_t low, std::size_t high) const { return x_[high] - x_[low] < spread; }

  // From the differences without the lowest and without the highest node.
  static Complex quotient(const Complex& above, const Complex& below, double step) {
    const Complex rise = above - below;
    return {rise.imag() / step, -rise.real() / step};
  }

  // Of a node and the next, up to four nodes together.
  Pairs pairs(std::size_t low) const {
    Pairs found;
    for (std::size_t n = 1; n < 4; ++n)
      found[n][0] = inverse_factorials[n - 1] * phasors_[low], found[0][n] = inverse_factorials[n - 1] * phasors_[low + 1];
    for (std::size_t a = 1; a < 4; ++a)
      for (std::size_t b = 1; a + b < 5; ++b) {
        Counts counts{};
        counts[low] = static_cast<int>(a), counts[low + 1] = static_cast<int>(b);
        found[a][b] = is_close(low, low + 1) ? series(counts) : quotient(found[a - 1][b], found[a][b - 1], x_[low + 1] - x_[low]);
      }
    return found;
  }

  // Of n nodes: sum_p h_p(j y) / (n - 1 + p)! times e^{j lowest}, y = x - lowest. With y below 1.5 the terms left out add up to
  // less than 1e-16.
  Complex series(const Counts& counts) const {
    const std::size_t low = counts[0] > 0 ? 0 : 1;
    std::array<double, most_nodes> y{};
    std::size_t n = 0;
    for (std::size_t i = low; i < 3; ++i)
      for (int c = 0; c < counts[i]; ++c) y[n++] = x_[i] - x_[low];
    std::array<double, most_nodes> h;  // h_p of the first 1, 2, ... nodes
    h.fill(1.0);
    std::array<double, 2> parts{};  // real and imaginary
    for (std::size_t p = 0; p < terms; ++p) {
      parts[p % 2] += (p % 4 < 2 ? 1.0 : -1.0) * inverse_factorials[n - 1 + p] * h[n - 1];
      double before = 0.0;
      for (std::size_t i = 0; i < n; ++i) before = h[i] = before + y[i] * h[i];
    }
    return phasors_[low] * Complex(parts[0], parts[1]);
  }

  std::array<double, 3> x_;
  std::array<Complex, 3> phasors_;
  Pairs lower_, upper_;
  std::array<Pairs, 4> triples_;  // by all counts
};

}  // namespace

std::array<Complex, 6> triangle_moments(const std::array<double, 3>& x) {
  std::array<std::size_t, 3> order{0, 1, 2};
  std::ranges::sort(order, {}, [&](std::size_t i) { return x[i]; });
  std::array<std::size_t, 3> place{};  // of a corner among the nodes
  for (std::size_t i = 0; i < 3; ++i) place[order[i]] = i;
  const Differences differences({x[order[0]], x[order[1]], x[order[2]]});
  const auto moment = [&](std::size_t i, std::size_t j) {
    Counts counts{1, 1, 1};
    ++counts[place[i]], ++counts[place[j]];
    return (i == j ? 4.0 : 2.0) * differences.of(counts);
  };
  return {moment(0, 0), moment(1, 1), moment(2, 2), moment(0, 1), moment(1, 2), moment(2, 0)};
}

}  // namespace raytube
