// What pairs of edge and face take, tried on a few before any light is looked for.
#pragma once

#include "utd/interaction/illuminated_faces.h"
#include "utd/interaction/pair_bound.h"

namespace raytube {

/// Pairs to try.
struct PairProbe {
  const ReceivingFaces& faces;           // with `by_area`
  std::span<const PatchExtent> extents;  // of all patches
  std::span<const EdgeAxis> axes;        // of all edges
  const PlaneWave& incident;
  const LookVectors& look;
  std::span<const double> wavenumbers;
  double tolerance;  // of their quadrature [m]
  int reflections;   // after the edge
};

/// Counted work (core/work.h) of the trials, and of a pair in the mean; one that would take more than `most` counts as `most`.
struct PairWork {
  double trials = 0.0, each = 0.0;
};

/// Tries pairs of the longest edges and the largest faces, the edges lit along their whole length.
PairWork try_pairs(const PairProbe& probe, double most);

}  // namespace raytube
