// Tubes as wide as the surfaces they meet allow: cut at edges and shadow boundaries, nowhere else.
#pragma once

#include <span>

#include "mesh/features/convexity.h"
#include "mesh/features/smooth.h"
#include "mesh/model/face_tree.h"
#include "mesh/trace/tracer.h"
#include "sbr/beams/current_map.h"
#include "sbr/beams/spherical_look.h"
#include "sbr/beams/tube_sums.h"
#include "sbr/launch/launch.h"
#include "sbr/visible/line_of_sight.h"

namespace raytube {

/// One look as its tubes see it.
struct AdaptiveLook {
  const Tracer& tracer;
  const FaceTree& tree;
  const LaunchGrid& grid;
  const SphericalBasis& transmit;
  const SphericalBasis& receive;
  const SphericalLook* spherical;  // antennas at a finite distance; null: plane waves
  std::span<const double> wavenumbers;
  const SpectralSurfaces& surfaces;
  double phase_tolerance;        // [rad] by which a curved surface may lie off its description
  const SmoothSurfaces* smooth;  // curved surfaces; null: all facets are flat
  bool clip;  // integrate over exactly the parts lit; else over the cells of the grid whose ray runs through them
  int max_bounces;
  bool skip;                        // empty cells of the grid
  Convexity known;                  // what need not be looked for
  const LineOfSightSheets* sheets;  // null: there are none
  CurrentMap* map;                  // currents are told to it, too, and by one thread; null: to no one
};

/// Follows the light that reaches the flat ones of the faces [begin, end) directly through all its reflections and integrates the
/// currents of every bounce. Without `clip` the sum over all faces is that of the uniform grid.
TubeSums trace_faces(const AdaptiveLook& look, std::uint32_t begin, std::uint32_t end);

}  // namespace raytube
