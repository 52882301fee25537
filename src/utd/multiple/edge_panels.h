// Points along an edge for the integral over its strips and all that follow from them. Notation in multiple_diffraction.h.
#pragma once

#include <span>
#include <vector>

#include "math/panel_rule.h"
#include "utd/multiple/wave_tree.h"

namespace raytube {

/// Cuts the lit pieces of an edge into panels, on each of which every strip of a tree, the first and those that follow from it,
/// ends at one edge: there its length is linear in the arc length of the first edge, and a Gauss rule converges fast. The cuts
/// are the ends of all bundles, so that a bundle's strips are those from successive points. Keeps its buffers.
class EdgePanels {
 public:
  /// The points of a bundle's strips, by index: [first, end).
  struct PointRange {
    std::uint32_t first, end;
    std::uint32_t size() const { return end - first; }
  };

  /// `wavelength` is the shortest of the band [m].
  explicit EdgePanels(double wavelength) : wavelength_(wavelength) {}

  /// Lays the panels of a tree on the lit pieces of its first edge, which is `length` [m] long.
  void lay(const WaveTree& tree, std::span<const LitInterval> lit, double length);

  /// Takes points that are given, in their order along the edge.
  void take(const WaveTree& tree, std::vector<PanelPoint> points);

  std::span<const PanelPoint> points() const { return points_; }
  /// One for each bundle of the tree.
  std::span<const PointRange> ranges() const { return ranges_; }

 private:
  void find_ranges(const WaveTree& tree);
  void fill(const WaveTree& tree, double begin, double end);
  Panel panel(const WaveTree& tree, double from, double to) const;
  std::uint32_t first_beyond(double arc_length) const;

  /// Where a panel lies on the edge [m] and its first point.
  struct LaidPanel {
    double middle;
    std::uint32_t first;
  };

  double wavelength_;
  std::vector<double> cuts_;
  std::vector<LaidPanel> panels_;
  std::vector<PanelPoint> points_;
  std::vector<PointRange> ranges_;
};

}  // namespace raytube
