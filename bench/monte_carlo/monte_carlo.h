// A Monte Carlo baseline: physical optics of flat, perfectly conducting facets as a path tracer integrates it. Rays set out from
// random points of a rectangle across the incident wave; each is a point sample of the currents where it lands. It shares the
// tracer and nothing else with the tubes of the solver (src/sbr), so it is a witness against them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/trace/tracer.h"
#include "scene/sweep.h"

namespace raytube::bench {

/// How often a sweep is drawn: rays a look and run, seed of the random numbers (core/random.h), independent runs.
struct Draws {
  std::uint64_t samples = 100000, seed = 1;
  int runs = 10;
};

/// What the rays of one look add up to.
struct RaySums {
  std::vector<ScatteringMatrix> scattering;  // [frequency] S [m], phase reference at the origin of the mesh's own coordinates
  std::uint64_t rays = 0;                    // traced, one a bounce
};

/// Rays from `samples` points drawn uniformly over the rectangle, each for area / samples of it. Each adds, wherever it lands,
/// the integrand of the radiation integral for all frequencies [Hz] and both transmitted polarisations: an unbiased estimate of
/// S with a standard error that falls as 1 / sqrt(samples). Far antennas. Streams of one seed never share a point.
RaySums ray_sums(const Tracer& tracer, const Look& look, std::span<const double> frequencies, int max_bounces,
                 std::uint64_t samples, std::uint64_t seed, std::uint64_t stream);

/// Every run of a sweep: [run][row]. Monostatic rows are made reciprocal, as those of the solver are. The same bits for any
/// number of threads; TBB chooses that.
using Runs = std::vector<std::vector<ScatteringMatrix>>;
Runs drawn_runs(const Tracer& tracer, const Sweep& sweep, int max_bounces, const Draws& draws);

/// The mean of the runs in one channel of a row, and how single runs scatter about it [m].
struct Spread {
  Complex mean;
  double deviation = 0.0;  // of one run: root of sum |S - mean|^2 / (runs - 1)
  double error = 0.0;      // of the mean: deviation / root of runs
};
Spread spread_of(const Runs& runs, std::size_t row, int receive, int transmit);

}  // namespace raytube::bench
