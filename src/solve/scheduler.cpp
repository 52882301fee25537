#include "solve/scheduler.h"

#include <algorithm>
#include <cmath>

#include "sbr/beams/tolerances.h"
#include "scene/frequency_bands.h"

namespace raytube {

bool Decision::any() const { return std::ranges::find(wanted, true) != wanted.end(); }

Scheduler::Scheduler(std::span<const double> frequencies, double tolerance_db)
    : frequencies_(frequencies), tolerance_(relative_tolerance(tolerance_db)) {}

// Of each band, root mean square over its frequencies of the weaker co-polar channel [m].
std::map<long, double> Scheduler::levels(const TubeSums& tubes) const {
  struct Squares {
    double vv = 0.0, hh = 0.0, count = 0.0;
  };
  std::map<long, Squares> sums;
  for (std::size_t f = 0; f < frequencies_.size(); ++f) {
    const ScatteringMatrix s = tubes.total(f);
    Squares& band = sums[band_of(frequencies_[f])];
    band.vv += std::norm(s.vv()), band.hh += std::norm(s.hh()), band.count += 1.0;
  }
  std::map<long, double> levels;
  for (const auto& [band, sum] : sums) levels[band] = std::sqrt(std::min(sum.vv, sum.hh) / sum.count);
  return levels;
}

Decision Scheduler::decide(const Prospect& prospect, const TubeSums& tubes) const {
  Decision decision{std::vector<bool>(frequencies_.size(), prospect.reach >= least_reach)};
  if (prospect.amplitude.empty()) return decision;
  const std::map<long, double> level = levels(tubes);
  for (std::size_t f = 0; f < frequencies_.size(); ++f) {
    const double amplitude = prospect.amplitude[f], beside = level.at(band_of(frequencies_[f]));
    if (amplitude > prospect.tolerances * tolerance_ * beside) continue;
    decision.wanted[f] = false;
    if (beside > 0.0) decision.most_db = std::max(decision.most_db, 20.0 * std::log10(1.0 + amplitude / beside));
  }
  return decision;
}

}  // namespace raytube
