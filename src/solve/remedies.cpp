#include "solve/remedies.h"

#include <fmt/format.h>

#include <numeric>

#include "solve/mechanisms/list.h"

namespace raytube {

namespace {

// Twice as many bounces, each as dear as the last one: later ones lose tubes.
std::string more_bounces(int bounces, const std::vector<std::uint64_t>& hits) {
  const double all = std::accumulate(hits.begin(), hits.end(), 0.0);
  const double last = hits.empty() ? 0.0 : static_cast<double>(hits.back());
  const double factor = all > 0.0 ? 1.0 + bounces * last / all : 2.0;
  return fmt::format("tubes.max_bounces = {}, at most {:.2g} times the time of the tubes", 2 * bounces, factor);
}

std::string remedy_of_cut_tubes(const TubeOptions& tubes, const Statistics& statistics) {
  const TruncatedSums& truncated = statistics.truncated;
  if (truncated[Truncation::bounces].sigma >= truncated[Truncation::width].sigma)
    return more_bounces(tubes.max_bounces, statistics.hits);
  return fmt::format("tubes.per_wavelength = {:.3g}, up to 4 times the time of the tubes", 2.0 * tubes.max_per_wavelength);
}

std::string remedy_of_facets(const TubeOptions& tubes) {
  if (const std::string remedy = remedy_of_flat_facets(tubes); !remedy.empty()) return remedy;
  return tubes.curved == CurvedSurfaces::always ? "a finer mesh" : text_of(Omission::facets).remedy;
}

}  // namespace

std::string remedy_of_flat_facets(const TubeOptions& tubes) {
  if (tubes.mode == TubeMode::uniform) return "tubes.mode = \"adaptive\", often less time";
  if (tubes.curved == CurvedSurfaces::never) return "tubes.curved = \"convex\", about the same time";
  return "";
}

std::string remedy_of(Omission omission, const SolvePlan& plan, const Statistics& statistics,
                      const std::vector<MechanismShown>& shown) {
  for (std::size_t i = 0; i < shown.size(); ++i)
    for (const MechanismRemedy& remedy : plan.mechanisms[i].remedies)
      if (remedy.omission == omission) return remedy.of(plan, shown[i]);
  if (omission == Omission::cut_tubes) return remedy_of_cut_tubes(plan.tubes, statistics);
  return omission == Omission::facets ? remedy_of_facets(plan.tubes) : text_of(omission).remedy;
}

}  // namespace raytube
