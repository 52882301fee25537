#include "utd/corner/order_nodes.h"

#include <cmath>

#include "math/gauss.h"

namespace raytube {

namespace {

/// Orders are cut off by a Gaussian in nu that falls to 1/e here.
constexpr double cutoff = 6.0;

/// Nodes from `from` to `to` along a straight line.
void add_line(Complex from, Complex to, int count, std::vector<OrderNode>& nodes) {
  for (const GaussPoint& point : gauss_rule(count)) {
    const Complex nu = from + point.node * (to - from);
    const Complex factor = 2.0 * nu * std::polar(1.0, -0.5 * pi) * std::exp(Complex(0, pi) * nu) / (nu * nu - 0.25);
    const double taper = std::exp(-nu.real() * nu.real() / (cutoff * cutoff));
    nodes.push_back({nu, factor * taper * point.weight * (to - from) / Complex(0, 2 * pi)});
  }
}

}  // namespace

std::vector<OrderNode> nodes_over_orders() {
  constexpr double left = 0.6, below = 0.4, top = 6.0, panel = 1.76;
  std::vector<OrderNode> nodes;
  add_line({left, 0}, {left, top}, 24, nodes);
  add_line({left, -below}, {left, 0}, 6, nodes);
  for (double x = left; x < 2.6 * cutoff; x += panel) add_line({x + panel, -below}, {x, -below}, 8, nodes);
  return nodes;
}

}  // namespace raytube
