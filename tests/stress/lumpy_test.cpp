// Irregular bodies, on which noses, rims and tips are found that no drawn body has, over frequencies far apart.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numeric>
#include <vector>

#include "lumpy_bodies.h"
#include "solve/solve.h"

namespace raytube {
namespace {

constexpr double reach = 0.85;  // [m]

SweepResult solved(unsigned seed, bool bistatic) {
  Sweep sweep;
  for (const double ka : {0.9, 3.5, 14.0, 28.0}) sweep.frequencies.push_back(ka * speed_of_light / (2 * pi * reach));
  for (const double theta : {60 * degree, 90 * degree})
    for (const double phi : {10 * degree, 100 * degree})
      sweep.looks.push_back({{theta, phi}, bistatic ? Direction{pi - theta, phi + 1.0} : Direction{theta, phi}});
  sweep.bistatic = bistatic;
  SolveOptions options;
  options.surfaces.waves = true;
  options.tubes.per_wavelength = options.tubes.max_per_wavelength = 3.0;
  return solve(Target(build_mesh(shapes::lumpy_body(seed, 3, reach), 1.0).mesh), sweep, options);
}

// Bodies 1 and 8 have noses that are edges at the lowest frequency and too round for them at the highest.
TEST(Lumpy, BodiesGiveNumbersWithinTheirBounds) {
#ifdef RAYTUBE_STRESS_FULL
  std::vector<unsigned> bodies(40);
  std::iota(bodies.begin(), bodies.end(), 1u);
#else
  const std::vector<unsigned> bodies{1, 3, 8};
#endif
  std::size_t rows = 0;
  for (const unsigned seed : bodies) {
    const SweepResult result = solved(seed, seed % 4 == 0);
    for (const ScatteringMatrix& s : result.total) EXPECT_TRUE(std::isfinite(frobenius_norm(s))) << seed;
    for (const BeyondBound& beyond : result.statistics.beyond_bound)
      ADD_FAILURE() << "body " << seed << ": " << beyond.part << ", " << beyond.rows << " rows, " << beyond.ratio;
    rows += result.total.size();
  }
  std::printf("measured: %zu rows of %zu bodies\n", rows, bodies.size());
}

}  // namespace
}  // namespace raytube
