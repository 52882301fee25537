// Monte Carlo baseline: the physics of sbr_scattering() as a path tracer integrates it. Rays from random points of the launch
// rectangle, each one a point sample of the currents where it lands. To compare with; no part of the solver.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/trace/tracer.h"
#include "sbr/sbr.h"
#include "scene/results.h"
#include "scene/sweep.h"

namespace raytube {

/// How many tubes a look gets, and the seed and stream of the random numbers that say where they set out (core/random.h).
struct RandomLaunch {
  std::uint64_t samples, seed, stream;
};

/// Sums and counts of the random tubes of one look.
struct RandomSums {
  std::vector<ScatteringMatrix> scattering;  // [frequency] S [m], phase reference at the origin of the mesh's coordinates
  std::vector<std::uint64_t> hits;           // [bounce]
  std::uint64_t rays = 0, lost_rays = 0;
  TruncatedSums truncated;  // of this look

  RandomSums& operator+=(const RandomSums& other);
};

/// Traces tubes from points drawn uniformly over the launch rectangle, each for the area of the rectangle / samples. Each adds,
/// at every bounce, the physical-optics integrand where it lands times that area, for all frequencies [Hz] and both transmit
/// polarisations: an unbiased estimate of the area integral with a standard error that falls as 1 / sqrt(samples). Of
/// `tubes`, `max_bounces` and `up` count; facets are flat. The result does not depend on the number of threads. `radar`: of
/// looks from a finite distance, whose rays run from the antenna through the points of the rectangle.
RandomSums random_tubes(const Tracer& tracer, const Look& look, std::span<const double> frequencies, const TubeOptions& tubes,
                        const RandomLaunch& launch, std::span<const Material> materials = {},
                        const Radar& radar = isotropic_radar);

}  // namespace raytube
