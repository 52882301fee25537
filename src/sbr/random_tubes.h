// The same physics by chance, as a path tracer has it: rays from random places of the launch rectangle, each one a point sample
// of the currents where it lands. A yardstick, no part of the solver.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/trace/tracer.h"
#include "sbr/sbr.h"
#include "scene/sweep.h"

namespace raytube {

/// How many tubes a look gets, and which numbers place them (random.h).
struct RandomLaunch {
  std::uint64_t samples, seed, stream;
};

/// What the random tubes of one look give.
struct RandomSums {
  std::vector<ScatteringMatrix> scattering;  // [frequency], phase reference at the origin of the mesh's coordinates [m]
  std::vector<std::uint64_t> hits;           // [bounce]
  std::uint64_t rays = 0, lost_rays = 0, tubes_truncated = 0;  // as of Statistics

  RandomSums& operator+=(const RandomSums& other);
};

/// Tubes from places drawn uniformly over the launch rectangle, each for the area of the rectangle / samples. Each adds, at every
/// bounce, the physical-optics integrand where it lands times that area, for all frequencies [Hz] and both transmit
/// polarisations: an unbiased estimate of the area integral with a standard error that falls as 1 / sqrt(samples). Of
/// `tubes`, `max_bounces` and `up` count; facets are flat. The same bytes for any number of threads.
RandomSums random_tubes(const Tracer& tracer, const Look& look, std::span<const double> frequencies, const TubeOptions& tubes,
                        const RandomLaunch& launch, std::span<const Material> materials = {});

}  // namespace raytube
