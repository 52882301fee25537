// The far field of what one lit piece of an edge paints on other surfaces, at all frequencies.
#pragma once

#include <vector>

#include "utd/interaction/edge_illumination.h"

namespace raytube {

/// What may be painted.
struct ReceivingFaces {
  const FaceTree& tree;
  std::span<const dvec3> corners;
  const std::vector<bool>& large;  // patches
};

struct IlluminatedFaces {
  std::vector<ScatteringMatrix> scattering;  // per wavenumber
  ChannelErrors error{};                     // estimated, of quadrature, at the worst of them
};

/// The integral of EdgeIllumination over all azimuths to within `tolerance`, as far as it can tell. Of many wavenumbers a few are
/// computed if the paths of the rays differ by little enough for these to stand for the others.
IlluminatedFaces illuminated_faces(const ReceivingFaces& faces, const LookVectors& look, std::span<const double> wavenumbers,
                                   const EdgeLight& light, int reflections, double tolerance);

}  // namespace raytube
