// Strips over curved faces: they follow geodesics, and their currents are integrated point by point. Notation in
// multiple_diffraction.h; docs/theory/surface_waves.md#edges.
//
// The current is that of a strip of the same length on a flat face, with the distance along the geodesic in the place of the
// straight one, times v (hard) or u (soft) of edge_factors.h, and times the root of the width that neighbouring geodesics leave
// it. Where the surface ends at a wedge it starts strips on both of its faces, as on a flat body.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "utd/multiple/strip_layout.h"

namespace raytube {

/// A point of a strip.
struct StripNode {
  double root;                          // of the distance s from its edge [m^(1/2)]
  double path;                          // s . (r - r_0) less that distance [m]
  double bend;                          // xi k^(-1/3) [m^(1/3)]
  double area;                          // root of the width over that at the edge
  int caustics;                         // passed
  std::array<double, 2> across, along;  // as FaceProjection
};

/// A strip from one point of an edge, and those that it starts where it ends.
struct StripPath {
  StripWave wave;
  dvec3 start;
  Strip strip;
  FaceProjection projection;     // at its edge
  std::vector<StripNode> nodes;  // none on a flat face
  double length = 0.0;           // [m]; infinite if it is taken as semi-infinite
  dvec3 end{0.0};
  std::vector<StripPath> next;  // on both faces of the wedge at its end
};

/// Unit waves that start a strip, per transmit polarisation, with quadrature weight and phase [m]: eta H along the edge, E along
/// it, and what of E goes on along the strip.
struct StripStart {
  std::array<Complex, 2> magnetic, electric, lying;
};

/// The strip of `wave` from a point of its edge and all that follow from it, to be integrated at wavelengths down to `wavelength`
/// and up to `longest`.
StripPath strip_path(const StripScene& scene, const StripWave& wave, const dvec3& point, double wavelength, double longest);

/// The strips of the waves of a tree that run over curved faces, by wave and in the order of their points.
using CurvedWaves = std::vector<std::vector<StripPath>>;
void find_curved_waves(const StripScene& scene, const StripLayout& strips, double wavelength, double longest, CurvedWaves& paths);

/// The waves that one which runs over a curved surface along `direction` starts at its end, on both faces of a wedge; `order`
/// strips one after another are followed, that one included.
std::vector<StripWave> waves_from(const StripScene& scene, const WedgeSide& end, const dvec3& direction, int order);

/// Adds S [m] of the strip at a wavenumber to `own`, and of those that follow from it to `further`.
void radiate(const StripPath& path, double wavenumber, const StripStart& start, ScatteringMatrix& own, ScatteringMatrix& further);

/// Counted (core/work.h): of one frequency.
double work_of(const StripPath& path);

/// Strips from the lit pieces of an edge: each path with its weight [m]. Close enough for phases to be summed, and closer where
/// neighbours end at places far apart.
struct WeightedPath {
  double weight;
  StripPath path;
};
std::vector<WeightedPath> strip_paths(const StripScene& scene, const StripWave& wave, std::span<const LitInterval> lit,
                                      double wavelength, double longest);

}  // namespace raytube
