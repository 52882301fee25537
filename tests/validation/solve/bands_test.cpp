// The rows of a frequency are the same alone and among others.
#include <gtest/gtest.h>

#include <cstring>

#include "run.h"
#include "shapes.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double low = 1e9, high = 10e9;  // [Hz]

// Two balls of 1280 facets that nearly touch. Their surfaces rise 3 mm above the facets: less than a wavelength / 32 at the lower
// frequency, at which waves run over them, and more at the higher one.
PolygonSoup two_balls() {
  PolygonSoup both = shapes::icosphere(3, 1.2);
  const PolygonSoup other = both;
  const auto first = static_cast<std::uint32_t>(both.points.size());
  for (const dvec3& p : other.points) both.points.push_back(p + dvec3(2.5, 0.0, 0.0));
  for (auto polygon : other.polygons) {
    for (std::uint32_t& corner : polygon) corner += first;
    both.polygons.push_back(polygon);
  }
  return both;
}

Sweep sweep_of(const std::vector<double>& frequencies) {
  return {frequencies, {{{1.2, 0.3}, {1.2, 0.3}}, {{1.5, 1.4}, {1.5, 1.4}}}, false};
}

TEST(Bands, AFrequencyIsTheSameBesideAnother) {
  const Target target(build_mesh(two_balls(), 1.0).mesh);
  SolveOptions options;
  options.surfaces.waves = true;
  options.edges.interaction = false;
  const Sweep both = sweep_of({high, low});
  const SolvePlan plan(target, both, options);
  ASSERT_EQ(plan.bands.size(), 2u);
  const SweepResult together = solve(plan);
  for (std::size_t f = 0; f < 2; ++f) {
    const SweepResult alone = solve(target, sweep_of({both.frequencies[f]}), options);
    for (std::size_t look = 0; look < both.looks.size(); ++look) {
      const std::size_t row = both.row(look, f);
      EXPECT_EQ(std::memcmp(&together.total[row], &alone.total[look], sizeof(ScatteringMatrix)), 0) << f << ' ' << look;
      EXPECT_EQ(together.error[row], alone.error[look]);
      EXPECT_EQ(together.model[row], alone.model[look]);
    }
  }
}

// One band: what many frequencies share moves rows by no more than the numerical error that is told.
TEST(Bands, NeighboursMoveARowByNoMoreThanItsError) {
  const Target target(build_mesh(shapes::dihedral(0.3, 0.2), 1.0).mesh);
  const std::vector<double> frequencies{9e9, 9.3e9, 9.6e9, 9.9e9, 10e9};
  const SweepResult together = solve(target, sweep_of(frequencies));
  for (std::size_t f = 0; f < frequencies.size(); ++f) {
    const Sweep one = sweep_of({frequencies[f]});
    const SweepResult alone = solve(target, one);
    for (std::size_t look = 0; look < one.looks.size(); ++look)
      for (int p = 0; p < 2; ++p) {
        const std::size_t row = look * frequencies.size() + f;
        const double error = together.error[row][p][p] + alone.error[look][p][p];
        EXPECT_LE(std::abs(together.total[row].at(p, p) - alone.total[look].at(p, p)), error) << f << ' ' << look;
      }
  }
}

}  // namespace
}  // namespace raytube
