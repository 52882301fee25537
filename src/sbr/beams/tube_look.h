// One look as its tubes need it: what they are launched from, what they meet, and where their currents are wanted.
#pragma once

#include <span>

#include "mesh/features/convexity.h"
#include "mesh/model/face_tree.h"
#include "mesh/smooth/smooth.h"
#include "mesh/trace/tracer.h"
#include "sbr/beams/spectrum.h"
#include "sbr/launch/launch.h"

namespace raytube {

class CurrentMap;
class LineOfSightSheets;
class SphericalLook;

/// All tubes of one look on one launch grid share it; nothing in it changes but the map.
struct TubeLook {
  const Tracer& tracer;
  const FaceTree& faces;
  const LaunchGrid& grid;
  const SphericalBasis& transmit;
  const SphericalBasis& receive;
  const SpectralSurfaces& surfaces;  // materials and wavenumbers
  const SphericalLook* spherical;    // antennas at a finite distance; null: plane waves
  const SmoothSurfaces* smooth;      // curved surfaces; null: all facets are flat
  const LineOfSightSheets* sheets;   // sheets that currents may stand behind; null: there are none
  CurrentMap* map;                   // takes every current as well, from one thread; null: none is asked for
  Convexity convexity;               // what need not be looked for
  double tolerance;                  // permitted error of S, as a share of it
  double phase_tolerance;            // by which a curved surface may lie off its description [rad]
  int max_bounces;
  bool skip;  // cells of the grid under which nothing lies launch no tube

  std::span<const double> wavenumbers() const { return surfaces.wavenumbers; }
};

}  // namespace raytube
