// The impedance that stands for a material beside an edge.
#pragma once

#include "scene/material.h"

namespace raytube {

/// The impedance of one face at one frequency, over eta: for E across the plane of incidence (soft at an edge met at a right
/// angle) and for E in it (hard). A perfect conductor has 0.
struct SurfaceImpedance {
  Complex soft, hard;
  double depth = 0.0;  // depth of the plane where it holds, below the face of the mesh [m]
};

/// From the reflection of a material that lets nothing through, Z = (1 + r) / (s (1 - r)) for E across and s (1 - r) / (1 + r)
/// for E in the plane of incidence: one number for all directions, so that edges are reciprocal. Of a coat it is that at grazing,
/// s
/// -> 0; r refers to its conductor, which is where its edge is: r = R e^{2jksd}. Of a medium it is that at broadside,
/// (mu/eps)^{1/2} (Leontovich 1948), which is vacuum's own where there is none. An `absorber` has that: it reflects nothing at
/// broadside. Roughness is not in it, as it does not count at grazing.
SurfaceImpedance surface_impedance(const Material& material, std::size_t frequency, double wavenumber);

}  // namespace raytube
