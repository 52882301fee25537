#include "utd/multiple/strip_groups.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

}  // namespace

void StripGroups::find(const StripLayout& strips, std::size_t waves, StripBins& bins) {
  rows_.clear();
  groups_.clear();
  first_.assign(1, 0);
  if (bins.pieces) starts_.assign(strips.panels.points().size(), none), ends_.assign(strips.arriving, none);
  for (std::size_t w = 0; w < waves; ++w) {
    const TreeWave& wave = strips.tree.waves()[w];
    for (std::uint32_t b = wave.first_bundle; b < wave.end_bundle; ++b)
      if (strips.rows[b].size > 0) bins.pieces ? take_apart(strips, w, b, bins) : cut(strips, w, b, bins.of(w));
    first_.push_back(groups_.size());
  }
}

bool StripGroups::splits(std::size_t wave) const {
  return std::ranges::any_of(of(wave), [](const StripGroup& group) { return group.part != StripPart::whole; });
}

void StripGroups::cut(const StripLayout& strips, std::size_t wave, std::uint32_t bundle, PathBins& bins) {
  const StripBundle& here = strips.tree.bundles()[bundle];
  const StripRow& row = strips.rows[bundle];
  const Linear &start = here.start_path, &end = here.end_path;
  const std::span<const PanelPoint> points = strips.panels.points().subspan(strips.panels.ranges()[bundle].first, row.size);
  const auto difference = [&](double at) { return std::abs(end.at(at) - start.at(at)); };
  if (strips.tree.runs_over_curved(strips.tree.waves()[wave].wave) ||
      std::max(difference(here.from), difference(here.to)) <= 2.0 * bins.spread())
    return put(StripPart::whole, {0.5 * (start.value + end.value), 0.5 * (start.growth + end.growth)}, points, row, bins);
  put(StripPart::start, start, points, row, bins);
  put(StripPart::end, end, points, row, bins);
}

// Point by point.
void StripGroups::take_apart(const StripLayout& strips, std::size_t wave, std::uint32_t bundle, StripBins& bins) {
  const TreeWave& here = strips.tree.waves()[wave];
  if (strips.tree.runs_over_curved(here.wave)) return;
  const StripBundle& strip = strips.tree.bundles()[bundle];
  const StripRow& row = strips.rows[bundle];
  const std::size_t point = strips.panels.ranges()[bundle].first;
  std::size_t* const starts = here.parent == no_index
                                  ? &starts_[point]
                                  : &ends_[strips.rows[here.parent].arriving + point - strips.panels.ranges()[here.parent].first];
  for (std::size_t i = 0; i < row.size; ++i) {
    const double at = strips.panels.points()[point + i].arc_length;
    const dvec3 first = strips.tree.waves()[0].line.at(at), start = here.line.at(at);
    const StripRow one{row.amplitude + i, row.arriving + i, row.kernel + (row.alike ? 0 : i), 1, row.alike};
    put_apart(one, {first, start, strip.start_path.at(at), starts[i]},
              {first, start + strip.length_at(at) * here.wave.direction, strip.end_path.at(at), ends_[one.arriving]}, bins);
  }
}

// What starts at the end of a strip has its place and its bin; a short strip has those of its start.
void StripGroups::put_apart(const StripRow& one, const StripEnd& start, const StripEnd& end, StripBins& bins) {
  const auto bin = [&](const StripEnd& at) {
    return at.bin = at.bin == none ? bins.at(bins.pieces->place.at(at.first, at.last, at.path)) : at.bin;
  };
  if (std::abs(end.path - start.path) <= one_piece(bins.nodes().front())) {
    append(StripPart::whole, end.bin = bin(start), one);
  } else {
    append(StripPart::start, bin(start), one);
    append(StripPart::end, bin(end), one);
  }
}

void StripGroups::put(StripPart part, const Linear& path, std::span<const PanelPoint> points, const StripRow& row,
                      PathBins& bins) {
  // Paths rise or fall all along the row.
  for (std::size_t i = 0, next = 0; i < row.size; i = next) {
    const std::int64_t key = bins.key(path.at(points[i].arc_length));
    const auto same = [&](const PanelPoint& point) { return bins.key(path.at(point.arc_length)) == key; };
    next = static_cast<std::size_t>(std::ranges::partition_point(points.subspan(i), same) - points.begin());
    append(part, bins.find(path.at(points[i].arc_length)),
           {row.amplitude + i, row.arriving + i, row.kernel + (row.alike ? 0 : i), next - i, row.alike});
  }
}

void StripGroups::append(StripPart part, std::size_t bin, const StripRow& row) {
  const bool anew = groups_.size() == first_.back() || groups_.back().part != part || groups_.back().bin != bin;
  if (anew) groups_.push_back({part, bin, rows_.size(), rows_.size()});
  rows_.push_back(row);
  groups_.back().end = rows_.size();
}

}  // namespace raytube
