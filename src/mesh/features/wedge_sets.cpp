#include "mesh/features/wedge_sets.h"

#include <algorithm>
#include <utility>

#include "mesh/features/resolved_wedges.h"

namespace raytube {

namespace {

// Those of the mesh, which is not theirs.
template <class Value>
std::shared_ptr<const Value> borrowed(const Value& value) {
  return {std::shared_ptr<const void>(), &value};
}

void find_set_wedges(const WedgeSource& source, double frequency, WedgeSet& set) {
  set.wedges = borrowed(source.wedges);
  set.outlines = borrowed(source.outlines);
  if (set.as_given()) return;
  std::vector<Wedge> wedges =
      set.thin_edges > 0 ? merge_thin_plate_edges(source.wedges, source.thin_plate_edges, thin_limit(frequency)) : source.wedges;
  if (set.detail_limit > 0.0) resolve_details(source.mesh, wedges, set.detail_limit, source.min_wedge_angle);
  set.outlines = std::make_shared<const Outlines>(source.mesh, wedges, source.min_wedge_angle);
  set.wedges = std::make_shared<const std::vector<Wedge>>(std::move(wedges));
}

}  // namespace

std::vector<WedgeSet> wedge_sets(const WedgeSource& source, std::span<const double> frequencies) {
  std::vector<WedgeSet> sets;
  for (std::size_t f = 0; f < frequencies.size(); ++f) {
    const double details = known_details(source.wedges, frequencies[f]);
    const std::size_t thin = count_thin(source.thin_plate_edges, frequencies[f]);
    auto set = std::ranges::find_if(
        sets, [&](const WedgeSet& known) { return known.thin_edges == thin && known.detail_limit == details; });
    if (set == sets.end()) set = sets.insert(sets.end(), {thin, details});
    set->indices.push_back(f);
  }
  for (WedgeSet& set : sets) find_set_wedges(source, frequencies[set.indices.front()], set);
  std::ranges::sort(sets, {}, [](const WedgeSet& set) { return std::pair(set.thin_edges, set.detail_limit); });
  return sets;
}

const WedgeSet& set_of(std::span<const WedgeSet> sets, std::size_t frequency_index) {
  return *std::ranges::find_if(
      sets, [&](const WedgeSet& set) { return std::ranges::find(set.indices, frequency_index) != set.indices.end(); });
}

}  // namespace raytube
