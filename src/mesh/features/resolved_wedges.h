// Wedges as a wave sees them that resolves nothing below some distance: a fold between facets narrower than that is part of what
// these facets make up together.
#pragma once

#include "mesh/features/wedges.h"

namespace raytube {

/// Details finer than this are not resolved at `frequency` [Hz]: the power of two between wavelength / 100 and wavelength / 50
/// that lies there [m], so that the frequencies of an octave share their wedges.
double detail_limit(double frequency);

/// That limit, or 0 if no wedge has a face so narrow that resolve_details could change it.
double known_details(std::span<const Wedge> wedges, double frequency);

/// Gives each wedge, thin plates' half planes apart, with a face narrower than `limit` [m] the faces that stand for its
/// surroundings. The surface's cross-section through its middle is followed for `limit` on either side; where one facet makes up
/// more than half of that it is the face, else the chord. If the faces differ from a plane by less than `min_wedge_angle` [rad]
/// the wedge is flat. Of several convex wedges within half of `limit` each counts for its share, and what ends within `limit`, a
/// ribbon or a wire, the less the narrower it is. Without such wedges they come back as they are.
void resolve_details(const TriangleMesh& mesh, std::span<Wedge> wedges, double limit, double min_wedge_angle);

}  // namespace raytube
