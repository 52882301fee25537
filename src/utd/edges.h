// The edge pass: what the wedges of a target add to physical optics, one look at a time.
#pragma once

#include <span>
#include <vector>

#include "field.h"
#include "mesh/tracer.h"
#include "mesh/wedges.h"
#include "sweep.h"

namespace raytube {

struct EdgeLookResult {
  std::vector<ScatteringMatrix> scattering;  // one per frequency; phase reference: centre of the mesh
  std::uint64_t wedges_lit = 0;
  std::vector<bool> windowed;  // per frequency: the forward-grazing window touched the row
};

/// Far-field amplitude of the fringe currents (Michaeli 1986, first order) on all convex wedges that the transmitter lights,
/// each clipped to its lit part, coherently summed in wedge order. Not symmetric in a
/// monostatic look: fringe currents are reciprocal on the Keller cone only.
EdgeLookResult fringe_scattering(std::span<const Wedge> wedges, const Tracer& tracer, const Look& look,
                                 std::span<const double> frequencies);

}  // namespace raytube
