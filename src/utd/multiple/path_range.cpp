#include "utd/multiple/path_range.h"

#include <algorithm>
#include <limits>

namespace raytube {

void PathRange::include(std::initializer_list<double> paths) {
  low = std::min(low, std::min(paths));
  high = std::max(high, std::max(paths));
}

// Along a strip the phase changes by its length times (s . sigma - 1), and where it ends the next ones start.
std::span<const PathRange> PathRanges::find(const WaveTree& tree, const LookVectors& look) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const dvec3 difference = look.scattered - look.incident;
  ranges_.clear();
  from_ends_.resize(tree.bundles().size());
  to_ends_.resize(tree.bundles().size());
  for (const TreeWave& wave : tree.waves()) {
    PathRange& range = ranges_.emplace_back(PathRange{infinity, -infinity});
    for (std::uint32_t b = wave.first_bundle; b < wave.end_bundle; ++b) {
      const StripBundle& bundle = tree.bundles()[b];
      const double change = bundle.edge ? glm::dot(look.scattered, wave.wave.direction) - 1.0 : 0.0;
      const double from = start(tree, wave, difference, bundle.from), to = start(tree, wave, difference, bundle.to);
      from_ends_[b] = from + change * bundle.length_at(bundle.from);
      to_ends_[b] = to + change * bundle.length_at(bundle.to);
      range.include({from, to, from_ends_[b], to_ends_[b]});
    }
  }
  return ranges_;
}

// Where the strip of this point of the first edge starts: on that edge, or at the end of the strip before, linear in between.
double PathRanges::start(const WaveTree& tree, const TreeWave& wave, const dvec3& difference, double arc_length) const {
  if (wave.parent == no_index) return glm::dot(difference, tree.waves()[0].line.at(arc_length));
  const StripBundle& before = tree.bundles()[wave.parent];
  const double share = before.to > before.from ? (arc_length - before.from) / (before.to - before.from) : 0.0;
  return from_ends_[wave.parent] + share * (to_ends_[wave.parent] - from_ends_[wave.parent]);
}

}  // namespace raytube
