// The same physics by chance: rays drawn at random, each one a sample of the currents where it lands.
#pragma once

#include "solve.h"

namespace raytube::bench {

struct MonteCarlo {
  std::vector<ScatteringMatrix> scattering;  // of each look, phase reference at the origin of the mesh's coordinates [m]
  std::uint64_t rays = 0;                    // segments traced
  double seconds = 0.0;
};

/// Launches `launched` rays a look from places drawn uniformly over the launch rectangle, at the sweep's first frequency. Each
/// adds, at every bounce, the physical-optics integrand at its place times rectangle / launched: an unbiased estimate of the area
/// integral with a standard error that falls as 1 / sqrt(launched). `seed` names the draw; the same bytes for any number of
/// threads.
MonteCarlo monte_carlo(const Target& target, const Sweep& sweep, int max_bounces, std::uint64_t launched, std::uint64_t seed,
                       int threads);

}  // namespace raytube::bench
