// Facets of different materials that lie upon one another.
#pragma once

#include "mesh/trace/tracer.h"

namespace raytube {

/// Pairs of triangles of different materials in one plane upon one another, that waves meet from a side they have in common:
/// which of the two they meet first is left to rounding, and the other one they do not meet at all.
struct Overlaps {
  std::uint64_t pairs = 0;
  std::array<std::uint32_t, 2> example{no_index, no_index};  // the triangles of the first pair
};

/// Those among the near-coincident facets of the tracer's mesh.
Overlaps overlaps_of_materials(const Tracer& tracer);

}  // namespace raytube
