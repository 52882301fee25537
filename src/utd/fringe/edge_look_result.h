// What the edges of a target radiate in one look.
#pragma once

#include <cstdint>
#include <vector>

#include "core/field.h"

namespace raytube {

/// S [m] of edge currents, one matrix per frequency; phase reference: centre of the mesh.
struct EdgeLookResult {
  EdgeLookResult() = default;
  /// Nothing yet at so many frequencies.
  EdgeLookResult(std::size_t frequencies, int order)
      : scattering(frequencies), higher(order > 1 ? frequencies : 0), windowed(frequencies) {}

  std::vector<ScatteringMatrix> scattering;  // the lit edges' own currents
  std::vector<ScatteringMatrix> higher;      // what these start at other edges; empty at first order
  std::uint64_t wedges_lit = 0;
  bool lit = false;            // any edge radiates
  std::vector<bool> windowed;  // per frequency: the forward-grazing window changed the sum
  double work = 0.0;           // counted, of this look (utd/wedge/work.h)

  /// Adds a part whose S becomes change(S, f) on its way.
  template <class Change>
  void add(const EdgeLookResult& part, Change change) {
    higher.resize(std::max(higher.size(), part.higher.size()));
    for (std::size_t f = 0; f < part.scattering.size(); ++f) {
      scattering[f] += change(part.scattering[f], f);
      if (!part.higher.empty()) higher[f] += change(part.higher[f], f);
      if (part.windowed[f]) windowed[f] = true;
    }
    lit = lit || part.lit;
    work += part.work;
  }
};

}  // namespace raytube
