// What the edges of a target radiate in one look.
#pragma once

#include <cstdint>
#include <vector>

#include "core/field.h"

namespace raytube {

/// S [m] of edge currents, one matrix per frequency; phase reference: centre of the mesh.
struct EdgeLookResult {
  std::vector<ScatteringMatrix> scattering;  // the lit edges' own currents
  std::vector<ScatteringMatrix> higher;      // what these start at other edges; empty at first order
  std::uint64_t wedges_lit = 0;
  bool lit = false;            // any edge radiates
  std::vector<bool> windowed;  // per frequency: the forward-grazing window changed the sum
  double work = 0.0;           // counted, of this look (utd/wedge/work.h)
};

}  // namespace raytube
