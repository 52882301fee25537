#include "utd/multiple/edge_panels.h"

#include <algorithm>
#include <cmath>

namespace raytube {

void EdgePanels::lay(const WaveTree& tree, std::span<const LitInterval> lit, double length) {
  points_.clear();
  panels_.clear();
  for (const LitInterval& piece : lit) fill(tree, piece.begin * length, piece.end * length);
  find_ranges(tree);
}

void EdgePanels::take(const WaveTree& tree, std::vector<PanelPoint> points) {
  points_ = std::move(points);
  panels_.clear();
  for (std::uint32_t i = 0; i < points_.size(); ++i) panels_.push_back({points_[i].arc_length, i});
  find_ranges(tree);
}

void EdgePanels::find_ranges(const WaveTree& tree) {
  ranges_.clear();
  for (const StripBundle& bundle : tree.bundles()) ranges_.push_back({first_beyond(bundle.from), first_beyond(bundle.to)});
}

void EdgePanels::fill(const WaveTree& tree, double begin, double end) {
  cuts_.clear();
  for (const StripBundle& bundle : tree.bundles())
    if (bundle.from >= begin && bundle.to <= end) cuts_.push_back(bundle.to);
  std::ranges::sort(cuts_);
  double from = begin;
  for (const double cut : cuts_) {
    if (cut - from < tree.rounding() || (cut < end && end - cut < tree.rounding())) continue;
    panels_.push_back({(from + cut) / 2, static_cast<std::uint32_t>(points_.size())});
    add_points(panel(tree, from, cut), wavelength_, points_);
    from = cut;
  }
}

// Strips that vanish within a twentieth of a panel's width beyond its end have their root there, as far as a rule can tell: two
// cuts may lie this close where a strip ends almost in a corner.
Panel EdgePanels::panel(const WaveTree& tree, double from, double to) const {
  Panel result{from, to};
  const double middle = (from + to) / 2, rounding = tree.rounding(), beside = rounding + 0.05 * (to - from);
  for (const StripBundle& bundle : tree.bundles()) {
    if (bundle.from > middle || bundle.to < middle) continue;
    result.path_rate = std::max({result.path_rate, std::abs(bundle.start_path.growth), std::abs(bundle.end_path.growth)});
    result.sweep = std::max(result.sweep, std::abs(bundle.growth));
    const auto vanishes = [&](double at) { return bundle.edge && std::abs(bundle.length_at(at)) < rounding; };
    if (from - bundle.from < beside && vanishes(bundle.from)) result.root[0] = true;
    if (bundle.to - to < beside && vanishes(bundle.to)) result.root[1] = true;
  }
  return result;
}

std::uint32_t EdgePanels::first_beyond(double arc_length) const {
  const auto panel = std::ranges::partition_point(panels_, [=](const LaidPanel& laid) { return laid.middle < arc_length; });
  return panel == panels_.end() ? static_cast<std::uint32_t>(points_.size()) : panel->first;
}

}  // namespace raytube
