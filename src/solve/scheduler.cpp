#include "solve/scheduler.h"

#include <algorithm>
#include <cmath>

#include "scene/tolerance.h"

namespace raytube {

bool Decision::any() const { return std::ranges::find(wanted, true) != wanted.end(); }

Decision decide(const Prospect& prospect, const TubeSums& tubes, std::size_t frequencies, double tolerance_db) {
  Decision decision{std::vector<bool>(frequencies, prospect.reach >= least_reach)};
  if (prospect.amplitude.empty()) return decision;
  for (std::size_t f = 0; f < frequencies; ++f) {
    const ScatteringMatrix s = tubes.total(f);
    const double amplitude = prospect.amplitude[f], beside = std::min(std::abs(s.vv()), std::abs(s.hh()));
    if (amplitude > prospect.tolerances * relative_tolerance(tolerance_db) * beside) continue;
    decision.wanted[f] = false;
    if (beside > 0.0) decision.most_db = std::max(decision.most_db, 20.0 * std::log10(1.0 + amplitude / beside));
  }
  return decision;
}

}  // namespace raytube
