// Fringe currents of edges whose faces have an impedance: coated conductors, media that let nothing through.
#pragma once

#include "utd/impedance/impedance_wedge.h"
#include "utd/impedance/surface_impedance.h"

namespace raytube {

/// S per length of edge, as edge_amplitude of conductors gives it; sets `windowed` like amplitude_at. Exact at normal incidence
/// for the impedances given. Obliquely E and H along the edge are taken apart, each with the impedance that belongs to k
/// sin(beta'); off the cone of diffraction g of edge_currents.h stands for pi - phi. First order; no end face of a coat, no wave
/// guided by it. What is taken off as physical optics has the reflection of these impedances, so that S is finite in every
/// direction that it is finite in for conductors.
ScatteringMatrix impedance_edge_amplitude(const Wedge& wedge, const WedgeIncidence& incidence,
                                          const std::array<SurfaceImpedance, 2>& faces, const LookVectors& look,
                                          double wavenumber, bool& windowed);

/// From the edge of the mesh to that of the planes where the impedances hold [m].
dvec3 edge_below(const Wedge& wedge, const std::array<SurfaceImpedance, 2>& faces);

}  // namespace raytube
