// S of the rims of thin material plates. Notation in sheet_admittance.h.
#pragma once

#include "utd/sheet/sheet_strips.h"

namespace raytube {

/// One look, rim after rim: what the plate's current near its rim has beyond physical optics and, from order 2 on, what it sends
/// to other rims. Keeps references to its arguments.
class SheetEdges {
 public:
  SheetEdges(const SheetScene& scene, const LookVectors& look, std::span<const double> frequencies, int order);

  /// Adds S [m] of a lit rim: of its own current to `first`, of all that follows to `higher`, per frequency.
  void add(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit,
           std::span<ScatteringMatrix> first, std::span<ScatteringMatrix> higher);

  /// Counted (utd/wedge/work.h).
  double work() const;

 private:
  ScatteringMatrix fringe(const RimLook& rim, double c, const SheetPair& pair, double shortest);

  SheetScene scene_;
  const LookVectors& look_;
  std::span<const double> frequencies_;
  int order_;
  SheetHalfPlanes half_planes_;
  SheetStrips strips_;
  double work_ = 0.0;
};

}  // namespace raytube
