// Which mechanisms a look needs: those that can move a co-polar row by the tolerance, and whose budget reaches far enough for the
// row to become truer. Decided by estimates and counted work alone.
#pragma once

#include <cstddef>
#include <vector>

#include "solve/mechanisms/mechanism.h"

namespace raytube {

/// What is decided of a mechanism in a look.
struct Decision {
  std::vector<bool> wanted;  // [frequency]
  double most_db = 0.0;      // by which it was expected to move a co-polar row at most where it is not wanted [dB]

  bool any() const;
};

/// Decides row by row: an amplitude of `prospect` counts if it moves the weaker co-polar channel of what tubes give there by more
/// than Prospect::tolerances times the tolerance. No row has a say in what another one needs.
Decision decide(const Prospect& prospect, const TubeSums& tubes, std::size_t frequencies, double tolerance_db);

}  // namespace raytube
