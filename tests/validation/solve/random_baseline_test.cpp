// Random tubes: unbiased, spread as Monte Carlo theory has it, edges taken over. Seeds are fixed: nothing here fails by chance.
#include <gtest/gtest.h>

#include "closed_forms.h"
#include "core/error.h"
#include "run.h"
#include "shapes.h"
#include "solve/random.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double frequency = 10e9;
const double k = wavenumber(frequency), lambda = wavelength(frequency);

RandomResult by_chance(PolygonSoup soup, const Sweep& sweep, const RandomOptions& random, EdgeMethod edges = EdgeMethod::none) {
  SolveOptions o = options(edges);
  o.tubes.mode = TubeMode::adaptive;
  o.tubes.max_per_wavelength = 40.0;
  const LoadedMesh loaded = build_mesh(std::move(soup), 1.0);
  return solve_with_random_tubes(Target(loaded.mesh), sweep, o, random);
}

// 4 standard errors of the mean, which are known to 1 / sqrt(2 * 2 * 99) = 5 %: a deviation so large comes by chance once in
// 10^4.
void expect_unbiased(const RandomResult& result, std::size_t row, int channel, Complex truth) {
  const double error = result.mean.error[row][channel][channel];
  EXPECT_GT(error, 0.0) << row;
  EXPECT_LE(std::abs(result.mean.total[row].at(channel, channel) - truth), 4.0 * error) << row << ", channel " << channel;
}

TEST(RandomBaseline, APlateIsUnbiased) {
  const double side = 5.0 * lambda, turn = 33.0 * degree;
  const Sweep sweep = monostatic({{0.05, 0.3}, {0.2, 1.9}, {0.5, 4.0}}, frequency);
  const RandomResult result = by_chance(shapes::plate(side, turn), sweep, {2000, 5, 100});
  for (std::size_t row = 0; row < sweep.rows(); ++row)
    for (const int channel : {0, 1})
      expect_unbiased(result, row, channel, closed_forms::plate(side, k, sweep.looks[row].transmit, turn));
}

TEST(RandomBaseline, BothBouncesOfADihedralAreUnbiased) {
  const double side = 5.0 * lambda;
  const Sweep sweep = monostatic({{pi / 2, 20 * degree}, {pi / 2, 43 * degree}, {pi / 2, 71 * degree}}, frequency);
  const RandomResult result = by_chance(shapes::dihedral(side, side), sweep, {2000, 7, 100});
  for (std::size_t row = 0; row < sweep.rows(); ++row)
    for (const int channel : {0, 1})
      expect_unbiased(result, row, channel,
                      closed_forms::dihedral(side, side, k, sweep.looks[row].transmit.phi, channel == 0 ? -1 : 1));
  EXPECT_EQ(result.mean.statistics.hits.size(), 2u);
  EXPECT_EQ(result.mean.statistics.tubes, 3u * 2000u * 100u);
}

// A plate that fills the launch rectangle: the integrand has the same magnitude everywhere, so one run's variance is
// (|S in phase|^2 - |S|^2) / samples. The sample variance of `runs` complex values has at least runs - 1 degrees of freedom, so
// it is off by sqrt(2 / (runs - 1)) in the mean: 10 % for 200 runs; 4 of these.
TEST(RandomBaseline, SpreadOfAPlateIsThatOfMonteCarloIntegration) {
  const double side = 5.0 * lambda;
  const Direction look{0.3, 0.0};
  const double in_phase = side * side / lambda * std::cos(look.theta), s = std::abs(closed_forms::plate(side, k, look));
  for (const std::uint64_t samples : {250u, 1000u, 4000u}) {
    const RandomResult result = by_chance(shapes::plate(side), monostatic({look}, frequency), {samples, 1, 200});
    const double variance = std::pow(result.spread[0][0][0].amplitude, 2);
    const double expected = (in_phase * in_phase - s * s) / static_cast<double>(samples);
    EXPECT_NEAR(variance / expected, 1.0, 0.4) << samples;
    EXPECT_NEAR(result.mean.error[0][0][0], std::sqrt(variance / 200.0), 1e-12 * s);
  }
}

// Face on every sample has the same phase and the plate fills the rectangle: whatever the places, the sum is exact to rounding.
TEST(RandomBaseline, APlateFaceOnHasNoSpread) {
  const double side = 5.0 * lambda;
  const RandomResult result = by_chance(shapes::plate(side), monostatic({{0.0, 0.0}}, frequency), {100, 3, 10});
  const double s = side * side / lambda;
  EXPECT_NEAR(std::abs(result.mean.total[0].vv()), s, 1e-12 * s);
  EXPECT_LE(result.spread[0][0][0].amplitude, 1e-12 * s);
  EXPECT_NEAR(result.spread[0][0][0].bias_db, 0.0, 1e-11);
}

// The rectangle along the sides of a turned plate is filled by it, too; the default one is not.
TEST(RandomBaseline, TheLaunchRectangleFollowsUp) {
  const double turn = 33.0 * degree;
  const LoadedMesh loaded = build_mesh(shapes::plate(5.0 * lambda, turn), 1.0);
  SolveOptions o = options(EdgeMethod::none);
  const Target target(loaded.mesh);
  const Sweep sweep = monostatic({{0.0, 0.0}}, frequency);
  const double beside = solve_with_random_tubes(target, sweep, o, {100, 3, 10}).spread[0][0][0].amplitude;
  o.tubes.up = dvec3(-std::sin(turn), std::cos(turn), 0.0);
  EXPECT_GT(beside, 1e-2 * lambda);
  EXPECT_LE(solve_with_random_tubes(target, sweep, o, {100, 3, 10}).spread[0][0][0].amplitude, 1e-9 * lambda);
}

// One look at many frequencies is one set of rays: each row is what its frequency alone would give.
TEST(RandomBaseline, FrequenciesShareTheRays) {
  Sweep both{{frequency, 1.01 * frequency}, {{{0.4, 0.2}, {0.4, 0.2}}}, false}, second = both;
  second.frequencies = {1.01 * frequency};
  const RandomResult a = by_chance(shapes::trihedral(5 * lambda), both, {500, 1, 2}),
                     b = by_chance(shapes::trihedral(5 * lambda), second, {500, 1, 2});
  EXPECT_EQ(a.mean.statistics.rays, b.mean.statistics.rays);
  EXPECT_LE(std::abs(a.mean.total[1].hh() - b.mean.total[0].hh()), 1e-12 * std::abs(b.mean.total[0].hh()));
}

// The mesh's origin far from its middle: the phase reference is the one of the deterministic solution.
TEST(RandomBaseline, PhaseReferenceIsTheOriginOfTheMesh) {
  PolygonSoup soup = shapes::transformed(shapes::plate(5.0 * lambda), glm::dmat3(1.0), 1.0, dvec3(1.0, 2.0, 3.0));
  const RandomResult result = by_chance(std::move(soup), monostatic({{0.1, 0.4}}, frequency), {4000, 1, 20});
  expect_unbiased(result, 0, 0, result.deterministic.total[0].vv());
}

TEST(RandomBaseline, EdgesAreThoseOfTheDeterministicSolution) {
  const Sweep sweep = monostatic({{0.3, 0.2}}, frequency);
  const RandomResult with = by_chance(shapes::cube(3 * lambda), sweep, {1000, 1, 4}, EdgeMethod::fringe),
                     without = by_chance(shapes::cube(3 * lambda), sweep, {1000, 1, 4});
  const double s = largest_amplitude(with.deterministic.total[0]);
  EXPECT_GT(largest_amplitude(with.mean.total[0] - without.mean.total[0]), 1e-3 * s);
  EXPECT_LE(largest_amplitude((with.mean.total[0] - with.deterministic.total[0]) -
                              (without.mean.total[0] - without.deterministic.total[0])),
            1e-12 * s);
}

TEST(RandomBaseline, SeedsAndRunsDrawOtherPlaces) {
  const Sweep sweep = monostatic({{0.3, 0.2}}, frequency);
  const RandomResult a = by_chance(shapes::plate(5 * lambda), sweep, {100, 1, 2}),
                     b = by_chance(shapes::plate(5 * lambda), sweep, {100, 2, 2});
  EXPECT_NE(a.mean.total[0].vv(), b.mean.total[0].vv());
  EXPECT_GT(a.spread[0][0][0].amplitude, 0.0);
}

TEST(RandomBaseline, NothingSeenEdgeOnIsNothing) {
  const RandomResult result = by_chance(shapes::plate(5 * lambda), monostatic({{pi / 2, 0.0}}, frequency), {100, 1, 2});
  EXPECT_EQ(largest_amplitude(result.mean.total[0]), 0.0);
  EXPECT_EQ(result.mean.error[0][0][0], 0.0);
}

TEST(RandomBaseline, BadOptionsAreRefused) {
  const Sweep sweep = monostatic({{0.3, 0.2}}, frequency);
  EXPECT_THROW(by_chance(shapes::plate(0.1), sweep, {0, 1, 2}), InputError);
  EXPECT_THROW(by_chance(shapes::plate(0.1), sweep, {10, 1, 1}), InputError);
  EXPECT_THROW(by_chance(shapes::plate(0.1), sweep, {10, 1, 2}, EdgeMethod::utd), InputError);
}

}  // namespace
}  // namespace raytube
