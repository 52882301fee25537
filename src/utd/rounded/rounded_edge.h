// S per unit length of a rounded edge, in the place of the fringe currents of a sharp one.
#pragma once

#include "utd/rounded/conic_section.h"
#include "utd/rounded/rounded_wedge.h"
#include "utd/wedge/edge_currents.h"

namespace raytube {

/// Edge of a wedge, whose start and end lie on the virtual apex, rounded by a section.
struct RoundedEdge {
  const Wedge& wedge;
  ConicSection section;
};

/// k times the geometric mean of the sines of both rays' angles to the edge, for which the modes of its section hold: so they are
/// reciprocal off the cone of diffracted rays too.
double wavenumber_across(const WedgeIncidence& incidence, const LookVectors& look, double wavenumber);

/// S per unit length of edge of the line source in the virtual apex, phases from there (no unit); the modes are those at the
/// wavenumber across the edge. Inside the metal of the wedge, where they are not defined, it is that along the nearer face and
/// fades to none in the middle.
ScatteringMatrix rounding_amplitude(const RoundedEdge& edge, const RoundedWedge& modes, const WedgeIncidence& incidence,
                                    const LookVectors& look);

/// S per unit length of edge of the physical-optics currents that the sharp wedge has beyond the rounded one: those of the lit
/// faces between the virtual apex and the section, less those of the lit part of that.
ScatteringMatrix missing_physical_optics(const RoundedEdge& edge, const WedgeIncidence& incidence, const LookVectors& look,
                                         double wavenumber);

/// All that a rounded edge adds to the physical optics of its faces and its section: the fringe currents of the sharp wedge and
/// both of the above.
ScatteringMatrix rounded_edge_amplitude(const RoundedEdge& edge, const RoundedWedge& modes, const WedgeIncidence& incidence,
                                        const LookVectors& look, double wavenumber);

}  // namespace raytube
