// Which parts of a wedge the transmitter sees.
#pragma once

#include <vector>

#include "mesh/tracer.h"
#include "utd/incidence.h"

namespace raytube {

/// A lit part of a wedge, as fractions of its length from wedge.start.
struct LitInterval {
  double begin;
  double end;
};

/// Fills `lit` (cleared first, capacity kept) with the parts of the wedge from which nothing but its own two patches lies on the
/// way `towards_transmitter` (unit). Test points stand at most half a wavelength apart, at least 8 and at most 128 of them from
/// end to end; each change between neighbours is then bisected to 1e-13 of the length. A shadow or a gap narrower than the
/// spacing can be missed.
void find_lit_intervals(const Wedge& wedge, const WedgeIncidence& incidence, const dvec3& towards_transmitter, double wavelength,
                        const Tracer& tracer, std::vector<LitInterval>& lit);

}  // namespace raytube
