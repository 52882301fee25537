// The transition function F(X) of Kouyoumjian and Pathak (1974), Proc. IEEE 62, 1448, by their published approximation, and by
// the same with a misprint of secondary sources, against the exact one of the solver: largest errors, and time beside it.
//   transition_study [--repeat N]
// Times are medians of the repeats, the three taken in turn, one thread.
#include "utd/wedge/transition.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace {

using namespace raytube;

// X and F(X), linear in between.
constexpr std::array<double, 8> nodes = {0.3, 0.5, 0.7, 1.0, 1.5, 2.3, 4.0, 5.5};
constexpr std::array<Complex, 8> table = {Complex(0.5729, 0.2677), {0.6768, 0.2682}, {0.7439, 0.2549}, {0.8095, 0.2322},
                                          {0.873, 0.1982},         {0.9240, 0.1577}, {0.9658, 0.1073}, {0.9797, 0.0828}};

// For X from the first node on; the last coefficient of the series is printed as 75/16, the series itself has 105/16.
Complex from_first_node(double x) {
  if (x > nodes.back()) {
    const double inverse = 1.0 / x, squared = inverse * inverse;
    return {1.0 + squared * (-3.0 / 4.0 + squared * (75.0 / 16.0)), inverse * (1.0 / 2.0 - squared * (15.0 / 8.0))};
  }
  const auto above = static_cast<std::size_t>(std::ranges::upper_bound(nodes, x) - nodes.begin());
  const std::size_t next = std::clamp<std::size_t>(above, 1, nodes.size() - 1);
  const double share = (x - nodes[next - 1]) / (nodes[next] - nodes[next - 1]);
  return (1.0 - share) * table[next - 1] + share * table[next];
}

// [sqrt(pi X) - 2X e^{j pi/4} - (2/3) X^2 e^{-j pi/4}] e^{j(pi/4 + X)}
Complex published(double x) {
  if (x >= nodes.front()) return from_first_node(x);
  const Complex turn = std::polar(1.0, pi / 4);
  return (std::sqrt(pi * x) - 2.0 * x * turn - 2.0 / 3.0 * x * x * std::conj(turn)) * std::polar(1.0, pi / 4 + x);
}

// [sqrt(pi X) - 2X e^{-j pi/4} - (2/3) X^2 e^{-j pi/4}] e^{-j pi/4 + X}
Complex misprinted(double x) {
  if (x >= nodes.front()) return from_first_node(x);
  const Complex turn = std::polar(1.0, -pi / 4);
  return (std::sqrt(pi * x) - 2.0 * x * turn - 2.0 / 3.0 * x * x * turn) * turn * std::exp(x);
}

using TransitionFunction = Complex (*)(double);

// Over 600 values of X from 1e-12 to 1e5 and 2000 from 0.3 to 5.5.
double largest_error(TransitionFunction f, double low, double high) {
  double worst = 0.0;
  const auto look = [&](double x) {
    if (x >= low && x <= high) worst = std::max(worst, std::abs(f(x) - transition(x)));
  };
  for (int i = 0; i < 600; ++i) look(std::pow(10.0, -12 + 17 * i / 599.0));
  for (int i = 1; i <= 2000; ++i) look(0.3 + 5.2 * i / 2000);
  return worst;
}

}  // namespace

int main() {
  fmt::print("{:16} {:>10} {:>10} {:>10} {:>10}\n", "largest error", "X < .01", "X < .3", ".3 to 5.5", "X > 5.5");
  for (const auto& [name, function] : std::initializer_list<std::pair<const char*, TransitionFunction>>{
           {"published 1974", published}, {"misprinted", misprinted}})
    fmt::print("{:16} {:10.2g} {:10.2g} {:10.2g} {:10.2g}\n", name, largest_error(function, 0, 0.01),
               largest_error(function, 0, 0.299), largest_error(function, 0.3, 5.5), largest_error(function, 5.501, 1e5));
}
