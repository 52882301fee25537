// The contract of mechanisms: what every piece of physics that adds to S beside the tubes answers. Who runs them (the scheduler
// of a look), who tells of them (check, run.json, skipped), images and pictures of rays ask this and nothing else.
//   state.h       of a plan: whether it takes part, and why not
//   mechanism.h   of a look: what it may add and whether its budget reaches far enough; then its sum at all frequencies
//   look_sums.h   what it adds, counts, and leaves out
//   list.h        all of them: a new mechanism is one line there
#pragma once

#include <vector>

#include "sbr/beams/tube_sums.h"
#include "scene/sweep.h"
#include "solve/mechanisms/look_sums.h"

namespace raytube {

/// A look whose tubes are done.
struct TracedLook {
  const Look& look;
  const TubeSums& tubes;  // done; at all frequencies of the band
};

/// Of the squares expected of a mechanism: one whose budget reaches less is not begun. A part of a sum whose terms are out of
/// phase is no better than none.
inline constexpr double least_reach = 0.5;

/// What is known of a mechanism in a look before it begins.
struct Prospect {
  std::vector<double> amplitude{};  // [frequency] what it may add to |S_pp|, an estimate [m]; empty: it runs in any case
  double tolerances = 1.0;          // of a row, that this must be for the mechanism to run
  double reach = 1.0;               // share of the squares expected of it that its budget allows
};

/// One mechanism at the frequencies of one band. Thread-safe.
class Mechanism {
 public:
  virtual ~Mechanism() = default;

  /// Cheap beside the tubes. `others` is what the mechanisms before it have added.
  virtual Prospect prospect(const TracedLook& look, const LookSums& others) const = 0;

  /// Adds what it gives to the sink, at the frequencies that are `wanted`; also the pieces of an image, if one is asked for.
  virtual void solve(const TracedLook& look, const std::vector<bool>& wanted, LookSink& sink) const = 0;

  /// Appends its rays over curved surfaces, for pictures; `arrivals` as of LookSink.
  virtual void trace(const Look&, std::vector<SurfaceArrival>& /*arrivals*/, std::vector<SurfaceRay>& /*rays*/) const {}
};

}  // namespace raytube
