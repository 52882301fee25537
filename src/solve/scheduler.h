// Which mechanisms a look needs: those that can move a co-polar row by the tolerance, and whose budget reaches far enough for the
// row to become truer. Decided by estimates and counted work alone.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "solve/mechanisms/mechanism.h"

namespace raytube {

/// What is decided of a mechanism in a look.
struct Decision {
  std::vector<bool> wanted;  // [frequency]
  double most_db = 0.0;      // by which it was expected to move a co-polar row at most where it is not wanted [dB]

  bool any() const;
};

/// Decides for the looks of a band. Bands of scene/frequency_bands.h are decided by themselves: of many frequencies none has a
/// say in what another one far away needs.
class Scheduler {
 public:
  /// `frequencies` [Hz] must outlive it.
  Scheduler(std::span<const double> frequencies, double tolerance_db);

  /// `prospect` against what tubes give in the look: an amplitude counts if it moves the weaker co-polar channel, in the mean
  /// over a band, by more than Prospect::tolerances times the tolerance.
  Decision decide(const Prospect& prospect, const TubeSums& tubes) const;

 private:
  std::map<long, double> levels(const TubeSums& tubes) const;

  std::span<const double> frequencies_;
  double tolerance_;  // of an amplitude, relative
};

}  // namespace raytube
