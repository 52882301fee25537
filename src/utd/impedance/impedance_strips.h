// Waves that edges of coats, of half-spaces and of absorbers send over their faces to the far edges. Notation in
// impedance_strip.h.
//
// Strips follow the grazing diffracted ray, as those of conductors do (Michaeli 1986): exact where edges are parallel. Second
// order: what comes back from the far edge is not followed.
#pragma once

#include "utd/impedance/impedance_strip.h"
#include "utd/impedance/impedance_table.h"

namespace raytube {

/// The strips of one look, face after face. Keeps references to its arguments.
class ImpedanceStrips {
 public:
  ImpedanceStrips(std::span<const Wedge> wedges, const Outlines& outlines, const ImpedanceTable& table, const LookVectors& look,
                  std::span<const double> frequencies);

  /// Adds S [m] of what strips over the faces of wedge `index` make at far edges of such materials, per frequency.
  void add(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit,
           std::span<ScatteringMatrix> sums);

  /// Counted (utd/wedge/work.h).
  double work() const { return work_; }

 private:
  void arrive(const StripEdge& from, double weight, const StripBundle& bundle, std::span<ScatteringMatrix> sums);

  std::span<const Wedge> wedges_;
  const ImpedanceTable& table_;
  const LookVectors& look_;
  std::span<const double> frequencies_;
  WaveTree tree_;
  MaliuzhinetsFunctions functions_{strip_digits};
  double work_ = 0.0;
};

}  // namespace raytube
