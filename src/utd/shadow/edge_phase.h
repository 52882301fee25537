// Integrals over the phase of a look along the lit parts of edges.
#pragma once

#include <span>
#include <vector>

#include "utd/shadow/edge_visibility.h"
#include "utd/wedge/edge_currents.h"

namespace raytube {

/// A straight lit piece of an edge in the phase of a look: integral of e^{jk (s - s') . r} = length sinc(k half_span)
/// e^{jk middle}.
struct EdgePhase {
  double length;     // [m]
  double half_span;  // (s - s') . l / 2 [m], l the vector from end to end
  double middle;     // (s - s') . c [m], c the piece's midpoint
};

/// Fills `pieces` (cleared first) with the lit pieces of an edge.
void find_phases(const Wedge& wedge, std::span<const LitInterval> lit, const LookVectors& look, std::vector<EdgePhase>& pieces);

/// The integral over all pieces [m].
Complex phase_integral(std::span<const EdgePhase> pieces, double wavenumber);

/// sum += amplitude phase.
void add_product(ScatteringMatrix& sum, const ScatteringMatrix& amplitude, Complex phase);

}  // namespace raytube
