// The Monte Carlo baseline (bench/monte_carlo): unbiased, spread as theory has it, and the solver's tubes are what it tends to.
// Seeds are fixed: nothing here fails by chance.
#include <gtest/gtest.h>

#include "closed_forms.h"
#include "core/threads.h"
#include "monte_carlo.h"
#include "run.h"
#include "shapes.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using bench::drawn_runs;
using bench::Draws;
using bench::Runs;
using bench::Spread;
using bench::spread_of;

constexpr double frequency = 10e9;
const double k = wavenumber(frequency), lambda = wavelength(frequency);

Runs by_chance(const Target& target, const Sweep& sweep, const Draws& draws, int threads = 0) {
  Runs runs;
  run_on_threads(threads, [&] { runs = drawn_runs(target.tracer, sweep, TubeOptions().max_bounces, draws); });
  return runs;
}

Runs by_chance(PolygonSoup soup, const Sweep& sweep, const Draws& draws) {
  return by_chance(Target(build_mesh(std::move(soup), 1.0).mesh), sweep, draws);
}

// 4 standard errors of the mean, which are known to 1 / sqrt(2 * 2 * 99) = 5 %: a deviation so large comes by chance once in
// 10^4.
void expect_unbiased(const Runs& runs, std::size_t row, int p, int q, Complex truth) {
  const Spread spread = spread_of(runs, row, p, q);
  EXPECT_GT(spread.error, 0.0) << row;
  EXPECT_LE(std::abs(spread.mean - truth), 4.0 * spread.error) << row << ", channel " << p << q;
}

TEST(RandomBaseline, APlateIsUnbiased) {
  const double side = 5.0 * lambda, turn = 33.0 * degree;
  const Sweep sweep = monostatic({{0.05, 0.3}, {0.2, 1.9}, {0.5, 4.0}}, frequency);
  const Runs runs = by_chance(shapes::plate(side, turn), sweep, {2000, 5, 100});
  for (std::size_t row = 0; row < sweep.rows(); ++row)
    for (const int channel : {0, 1})
      expect_unbiased(runs, row, channel, channel, closed_forms::plate(side, k, sweep.looks[row].transmit, turn));
}

TEST(RandomBaseline, BothBouncesOfADihedralAreUnbiased) {
  const double side = 5.0 * lambda;
  const Sweep sweep = monostatic({{pi / 2, 20 * degree}, {pi / 2, 43 * degree}, {pi / 2, 71 * degree}}, frequency);
  const Runs runs = by_chance(shapes::dihedral(side, side), sweep, {2000, 7, 100});
  for (std::size_t row = 0; row < sweep.rows(); ++row)
    for (const int channel : {0, 1})
      expect_unbiased(runs, row, channel, channel,
                      closed_forms::dihedral(side, side, k, sweep.looks[row].transmit.phi, channel == 0 ? -1 : 1));
}

// A plate that fills the rectangle: the integrand has the same magnitude everywhere, so one run's variance is
// (|S in phase|^2 - |S|^2) / samples. The sample variance of `runs` complex values has at least runs - 1 degrees of freedom, so
// it is off by sqrt(2 / (runs - 1)) in the mean: 10 % for 200 runs; 4 of these.
TEST(RandomBaseline, SpreadOfAPlateIsThatOfMonteCarloIntegration) {
  const double side = 5.0 * lambda;
  const Direction look{0.3, 0.0};
  const double in_phase = side * side / lambda * std::cos(look.theta), s = std::abs(closed_forms::plate(side, k, look));
  for (const std::uint64_t samples : {250u, 1000u, 4000u}) {
    const Spread spread = spread_of(by_chance(shapes::plate(side), monostatic({look}, frequency), {samples, 1, 200}), 0, 0, 0);
    const double variance = spread.deviation * spread.deviation;
    EXPECT_NEAR(variance * static_cast<double>(samples) / (in_phase * in_phase - s * s), 1.0, 0.4) << samples;
    EXPECT_NEAR(spread.error, std::sqrt(variance / 200.0), 1e-12 * s);
  }
}

// Face on every sample has the same phase and the plate fills the rectangle: whatever the places, the sum is exact to rounding.
TEST(RandomBaseline, APlateFaceOnHasNoSpread) {
  const double side = 5.0 * lambda, s = side * side / lambda;
  const Spread spread = spread_of(by_chance(shapes::plate(side), monostatic({{0.0, 0.0}}, frequency), {100, 3, 10}), 0, 0, 0);
  EXPECT_NEAR(std::abs(spread.mean), s, 1e-12 * s);
  EXPECT_LE(spread.deviation, 1e-12 * s);
}

TEST(RandomBaseline, NothingSeenEdgeOnIsNothing) {
  const Spread spread =
      spread_of(by_chance(shapes::plate(5 * lambda), monostatic({{pi / 2, 0.0}}, frequency), {100, 1, 2}), 0, 0, 0);
  EXPECT_EQ(spread.mean, 0.0);
  EXPECT_EQ(spread.error, 0.0);
}

TEST(RandomBaseline, SeedsAndRunsDrawOtherPlaces) {
  const Sweep sweep = monostatic({{0.3, 0.2}}, frequency);
  const Spread a = spread_of(by_chance(shapes::plate(5 * lambda), sweep, {100, 1, 2}), 0, 0, 0),
               b = spread_of(by_chance(shapes::plate(5 * lambda), sweep, {100, 2, 2}), 0, 0, 0);
  EXPECT_NE(a.mean, b.mean);
  EXPECT_GT(a.deviation, 0.0);
}

TEST(RandomBaseline, ThreadsDoNotShow) {
  const Target target(build_mesh(shapes::trihedral(0.3), 1.0).mesh);
  const Sweep sweep{{9e9, 10e9}, {{{0.3, 0.2}, {0.3, 0.2}}, {{0.9, 0.7}, {0.9, 0.7}}}, false};
  const Runs one = by_chance(target, sweep, {10000, 1, 3}, 1), seven = by_chance(target, sweep, {10000, 1, 3}, 7);
  for (std::size_t run = 0; run < one.size(); ++run)
    for (std::size_t row = 0; row < sweep.rows(); ++row) EXPECT_EQ(one[run][row].s, seven[run][row].s);
}

// What the solver's tubes of every bounce add up to, refined far below the spread, at two frequencies.
struct Witnessed {
  const char* name;
  PolygonSoup soup;
  std::vector<Look> looks;
};

void expect_witnessed(const Witnessed& body, bool bistatic) {
  const Sweep sweep{{frequency, 1.07 * frequency}, body.looks, bistatic};
  const Target target(build_mesh(body.soup, 1.0).mesh);
  SolveOptions o = options(EdgeMethod::none);
  o.tubes = {};
  o.tubes.tolerance_db = 0.01;
  o.tubes.curved = CurvedSurfaces::never;
  const SweepResult result = solve(target, sweep, o);
  const Runs runs = by_chance(target, sweep, {2000, 5, 100});
  for (std::size_t row = 0; row < sweep.rows(); ++row)
    for (const int channel : {0, 1, 2, 3}) {
      const int p = channel / 2, q = channel % 2;
      const Spread spread = spread_of(runs, row, p, q);
      EXPECT_LE(std::abs(spread.mean - result.total[row].at(p, q)),
                4.0 * spread.error + 1e-3 * largest_amplitude(result.total[row]))
          << body.name << row << p << q;
    }
}

Look seen(double theta, double phi) { return {{theta * degree, phi * degree}, {theta * degree, phi * degree}}; }

TEST(RandomBaseline, TheSolversTubesAreWhatItTendsTo) {
  const PolygonSoup off_origin = shapes::transformed(shapes::plate(5.0 * lambda), glm::dmat3(1.0), 1.0, dvec3(1.0, 2.0, 3.0));
  for (const Witnessed& body : {Witnessed{"plate off the origin", off_origin, {seen(6, 23), seen(3, 100)}},
                                {"dihedral", shapes::dihedral(5 * lambda, 4 * lambda), {seen(88, 43), seen(80, 20)}},
                                {"trihedral", shapes::trihedral(5 * lambda), {seen(50, 40), seen(62, 57)}},
                                {"cube", shapes::cube(4 * lambda), {seen(88, 3), seen(90, 1)}},
                                {"sphere of facets", shapes::icosphere(2, 2 * lambda), {seen(40, 70)}}})
    expect_witnessed(body, false);
}

TEST(RandomBaseline, TheSolversTubesAreWhatItTendsToBistatic) {
  const auto to = [](Look look, double theta, double phi) { return Look{look.transmit, {theta * degree, phi * degree}}; };
  for (const Witnessed& body :
       {Witnessed{"dihedral", shapes::dihedral(5 * lambda, 4 * lambda), {to(seen(88, 43), 85, 44), to(seen(80, 20), 99, 21)}},
        {"trihedral", shapes::trihedral(5 * lambda), {to(seen(50, 40), 52, 43)}},
        {"cube", shapes::cube(4 * lambda), {to(seen(80, 30), 100, -28)}}})
    expect_witnessed(body, true);
}

}  // namespace
}  // namespace raytube
