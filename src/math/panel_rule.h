// Quadrature on one panel of an edge.
#pragma once

#include <array>
#include <vector>

namespace raytube {

/// A piece of an edge over which the strips' contributions are smooth inside.
struct Panel {
  double from, to;             // [m] along the edge
  double path_rate = 0.0;      // largest change of a phase per metre, over k
  double sweep = 0.0;          // how far the strips' ends move per metre, at most
  std::array<bool, 2> root{};  // strips vanish at this end: the integrand is smooth in the root of the distance to it
};

struct PanelPoint {
  double arc_length;  // [m] along the edge
  double weight;      // [m]; the weights add up to to - from
};

/// Appends the points of a rule that is good to some 1e-4 of a wavelength in S for an edge of some wavelengths, and converges
/// exponentially. Long panels are cut.
void add_points(const Panel& panel, double wavelength, std::vector<PanelPoint>& points);

}  // namespace raytube
