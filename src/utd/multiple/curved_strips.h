// Strips over curved faces: they follow geodesics, and their currents are integrated point by point. Notation in
// multiple_diffraction.h; docs/theory/surface_waves.md#edges.
//
// The current is that of a strip of the same length on a flat face, with the distance along the geodesic in the place of the
// straight one, times v (hard) or u (soft) of edge_factors.h, and times the root of the width that neighbouring geodesics leave
// it. Where the surface ends at a wedge it starts strips on both of its faces, as on a flat body.
#pragma once

#include <span>
#include <vector>

#include "utd/multiple/strip_path.h"

namespace raytube {

/// The strip of `wave` from a point of its edge and all that follow from it, to be integrated at the wavelengths of the scene.
StripPath strip_path(const StripScene& scene, const StripWave& wave, const dvec3& point);

/// The strips of the waves of a tree that run over curved faces, by wave and in the order of their points; empty where no face is
/// curved.
struct ArrivedPath {
  double start_path;  // of the phase at its start, over k [m]
  StripPath path;
  std::uint32_t points = 1;  // neighbours for which it stands
};
using CurvedWaves = std::vector<std::vector<ArrivedPath>>;

/// Those of a first wave from the lit pieces of its edge, and the points where they start, close enough for phases to be summed,
/// and closer where neighbours end at places far apart.
std::vector<ArrivedPath> first_curved_strips(const StripScene& scene, const StripWave& wave, std::span<const LitInterval> lit,
                                             std::vector<PanelPoint>& points);

/// Adds those of all further waves of a tree.
void find_curved_waves(const StripScene& scene, const StripLayout& strips, CurvedWaves& paths);

/// The waves that one which runs over a curved surface along `direction` starts at its end, on both faces of a wedge; `order`
/// strips one after another are followed, that one included.
std::vector<StripWave> waves_from(const StripScene& scene, const WedgeSide& end, const dvec3& direction, int order);

/// Counted (utd/wedge/work.h): of one wavenumber.
double work_of(const StripPath& path);

}  // namespace raytube
