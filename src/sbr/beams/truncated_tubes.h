// Tubes that are truncated: at the last bounce, or because there are too many of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include "mesh/trace/tracer.h"
#include "sbr/beams/spectrum.h"
#include "sbr/beams/tube_sums.h"

namespace raytube {

/// Between sheets tubes double at every meeting. With more than this under way in a tile the weakest end, counted as
/// truncated.
inline constexpr std::size_t most_tubes = 32768;

/// Keeps so many tubes, those of the largest weight(tube), the first ones where these are equal, and calls end(tube) for each of
/// the others.
template <class Tube, class Weight, class End>
void end_weakest(std::vector<Tube>& tubes, std::size_t most, Weight weight, End end) {
  if (tubes.size() <= most) return;
  std::vector<double> weights;
  for (const Tube& tube : tubes) weights.push_back(weight(tube));
  const auto kept = weights.begin() + static_cast<std::ptrdiff_t>(most);
  std::ranges::nth_element(weights, kept, std::greater());
  const double limit = *kept;
  auto as_weak = std::count(weights.begin(), kept, limit);
  std::erase_if(tubes, [&](const Tube& tube) {
    const double w = weight(tube);
    if (w > limit || (w == limit && as_weak-- > 0)) return false;
    end(tube);
    return true;
  });
}

/// Counts a truncated tube of this area [m^2] and amplitude.
inline void count_truncated(TruncatedSum& sum, double area, double amplitude) {
  ++sum.tubes;
  sum.add(area, amplitude);
}

/// A tube that was truncated on its way to `hit`.
struct TruncatedTube {
  Ray ray;
  Hit hit;
  double area, amplitude;  // across its wave [m^2]; of unit incident waves
};

/// Counts what a truncated tube would have brought: what a sheet at its hit reflects, what the next one behind it does, and so
/// on.
void count_truncated(TruncatedSum& sum, const Tracer& tracer, const SpectralSurfaces& surfaces, TruncatedTube tube);

}  // namespace raytube
