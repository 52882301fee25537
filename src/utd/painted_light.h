// The far field of what one lit piece of an edge paints on other surfaces, at all frequencies.
#pragma once

#include <vector>

#include "utd/edge_painter.h"

namespace raytube {

/// What may be painted.
struct Canvas {
  const FaceTree& tree;
  std::span<const dvec3> corners;
  const std::vector<bool>& large;  // patches
};

struct PaintedLight {
  std::vector<ScatteringMatrix> scattering;  // per wavenumber
  ChannelErrors error{};                     // estimated, of quadrature, at the worst of them
};

/// The integral of EdgePainter over all azimuths to within `tolerance`, as far as it can tell. Of many wavenumbers a few are
/// computed if the paths of the rays differ by little enough for these to stand for the others.
PaintedLight painted_light(const Canvas& canvas, const LookVectors& look, std::span<const double> wavenumbers,
                           const EdgeLight& light, int reflections, double tolerance);

}  // namespace raytube
