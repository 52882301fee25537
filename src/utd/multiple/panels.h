// Points along an edge for the integral over its strips and all that follow from them.
#pragma once

#include <span>
#include <vector>

#include "math/panel_rule.h"
#include "utd/multiple/wave_tree.h"

namespace raytube {

/// Cuts the lit pieces of an edge into panels, on each of which every strip of a tree, the first and those that follow from it,
/// ends at one edge: there its length is linear in the place on the first edge, and a Gauss rule converges fast. The cuts are the
/// ends of all bundles, so that a bundle's strips are those from a row of points.
class PanelPlacer {
 public:
  /// Places of a bundle's strips among the points: [first, end).
  struct Row {
    std::uint32_t first, end;
    std::uint32_t size() const { return end - first; }
  };

  /// `wavelength` is the shortest of the look.
  explicit PanelPlacer(double wavelength) : wavelength_(wavelength) {}

  /// The points for a tree on the lit pieces [m] of its first edge.
  void place(const WaveTree& tree, std::span<const LitInterval> lit, double length);

  std::span<const PanelPoint> points() const { return points_; }
  /// One for each bundle of the tree.
  std::span<const Row> rows() const { return rows_; }

 private:
  void fill(const WaveTree& tree, double begin, double end);
  Panel panel(const WaveTree& tree, double from, double to) const;
  std::uint32_t first_beyond(double place) const;

  /// Where a panel lies and its first point.
  struct Placed {
    double middle;
    std::uint32_t first;
  };

  double wavelength_;
  std::vector<double> cuts_;
  std::vector<Placed> panels_;
  std::vector<PanelPoint> points_;
  std::vector<Row> rows_;
};

}  // namespace raytube
