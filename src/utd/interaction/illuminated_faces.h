// The far field of the currents that one lit piece of an edge excites on other faces, at all frequencies.
#pragma once

#include <vector>

#include "utd/interaction/edge_illumination.h"

namespace raytube {

struct IlluminatedFaces {
  std::vector<ScatteringMatrix> scattering;  // per wavenumber [m]; phase reference: origin of the mesh's coordinates
  ChannelErrors error{};                     // estimated, of quadrature, at the worst of them [m]
  double work = 0.0;                         // counted (utd/wedge/work.h)
  std::vector<ImageEdge> pieces{};           // those of the only wavenumber, each at the place of its path, if asked for
};

struct IlluminationLimits {
  int reflections;                         // after the edge
  double tolerance;                        // at which the integral over the azimuth stops, as far as it can tell [m]
  std::span<const AzimuthRange> wanted{};  // where there is anything to illuminate; empty: all round
  const PathPlace* place = nullptr;        // where pieces are put; null: none are asked for
};

/// The integral of EdgeIllumination over all azimuths. Of many wavenumbers a few are computed if the paths of the rays differ by
/// little enough for these to stand for the others.
IlluminatedFaces illuminated_faces(const ReceivingFaces& faces, const LookVectors& look, std::span<const double> wavenumbers,
                                   const LitEdgePiece& source, const IlluminationLimits& limits);

}  // namespace raytube
