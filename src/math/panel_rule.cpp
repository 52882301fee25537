#include "math/panel_rule.h"

#include <cmath>
#include <optional>

#include "math/gauss.h"

namespace raytube {

namespace {

// A rule of N points integrates N 2/pi cycles of phase and a little more; the rest of the strips' variation is smooth.
constexpr double least_points = 4.0;
constexpr double points_per_cycle = 1.6;
constexpr double points_per_wavelength = 1.0;
constexpr double steepest_slope = 1.5;  // of the position against the rule's variable, where both ends have a root
constexpr double slack = 1e-6;          // keeps a decision the same on bodies of whole wavelengths, whatever the rounding
constexpr double root_part = 1.0;       // [wavelengths] on a long panel a root matters this far from its end

bool has_root(const Panel& panel) { return panel.root[0] || panel.root[1]; }

double point_count(const Panel& panel, double wavelength) {
  const double slope = has_root(panel) ? steepest_slope : 1.0;
  const double per_wavelength = points_per_cycle * slope * panel.path_rate + points_per_wavelength * (1 + panel.sweep);
  return std::floor(least_points + per_wavelength * (panel.to - panel.from) / wavelength + slack);
}

std::optional<double> place_to_cut(const Panel& panel, double wavelength) {
  const double part = root_part * wavelength;
  const bool is_long = panel.to - panel.from > (2 + slack) * part;
  const bool both = panel.root[0] && panel.root[1];  // in the middle: the same cut from either end
  if ((is_long && both) || point_count(panel, wavelength) > most_gauss_points) return (panel.from + panel.to) / 2;
  if (is_long && panel.root[0]) return panel.from + part;
  if (is_long && panel.root[1]) return panel.to - part;
  return std::nullopt;
}

/// A position on [0, 1] as a polynomial of the rule's variable in which roots of the distance to the ends are smooth.
struct Mapped {
  double arc_length, slope;
};
Mapped mapped(double x, const std::array<bool, 2>& root) {
  if (root[0] && root[1]) return {x * x * (3 - 2 * x), 6 * x * (1 - x)};
  if (root[0]) return {x * x, 2 * x};
  if (root[1]) return {x * (2 - x), 2 * (1 - x)};
  return {x, 1.0};
}

}  // namespace

void add_points(const Panel& panel, double wavelength, std::vector<PanelPoint>& points) {
  if (const auto cut = place_to_cut(panel, wavelength)) {
    Panel first = panel, second = panel;
    first.to = second.from = *cut;
    first.root[1] = second.root[0] = false;
    add_points(first, wavelength, points);
    add_points(second, wavelength, points);
    return;
  }
  const double width = panel.to - panel.from;
  for (const GaussPoint& point : gauss_rule(static_cast<int>(point_count(panel, wavelength)))) {
    const Mapped at = mapped(point.node, panel.root);
    points.push_back({panel.from + width * at.arc_length, width * at.slope * point.weight});
  }
}

}  // namespace raytube
