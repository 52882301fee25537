// Smooth bodies of few and of many facets: error bars hold what the facets do, at every density and wavelength, and what they do
// falls with density.
#include <gtest/gtest.h>

#include <array>

#include "run.h"
#include "smooth_bodies.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using shapes::FacetKind;

// About the body: six general looks, and none along an axis, where rows are alike.
const std::vector<Direction> looks = {{83 * degree, 7 * degree}, {47 * degree, 31 * degree},  {83 * degree, 31 * degree},
                                      {47 * degree, 7 * degree}, {65 * degree, 110 * degree}, {20 * degree, 200 * degree}};

SweepResult rows_of(const PolygonSoup& soup, const std::vector<double>& frequencies) {
  Sweep sweep = monostatic(looks, frequencies[0]);
  sweep.frequencies = frequencies;
  SolveOptions options;
  options.edges.method = EdgeMethod::none;
  return solve(Target(build_mesh(soup, 1.0).mesh), sweep, options);
}

struct Count {
  int rows = 0, covered = 0;
  std::vector<double> errors;  // |dB|
};

// Rows whose error, against a mesh of many facets, is no more than they say; twice the error of those (.01 dB) is left out.
void compare(const SweepResult& found, const SweepResult& reference, Count& count) {
  for (std::size_t row = 0; row < found.total.size(); ++row) {
    const double s = std::abs(found.total[row].vv()), told = std::hypot(found.error[row][0][0], found.model[row][0][0]);
    const double error = std::abs(dbsm(s) - dbsm(reference.total[row].vv()));
    ++count.rows;
    count.covered += error <= 20.0 * std::log10(1.0 + told / s) + 0.02 ? 1 : 0;
    count.errors.push_back(error);
  }
}

// ka 19, 63 and 188 for a radius of .3 m. Half a wavelength is an eleventh of the coarsest facets' sides at the highest of them.
const std::vector<double> frequencies = {3e9, 10e9, 30e9};

constexpr std::array kinds = {FacetKind::geodesic, FacetKind::longitudes, FacetKind::uneven};

// Half axes [m].
constexpr std::array<std::array<double, 2>, 4> spheroids = {{{0.3, 0.3}, {0.15, 0.3}, {0.075, 0.3}, {0.3, 0.1}}};

// One row in ten may lie outside; fewer facets leave creases at tips and rims that are edges.
TEST(CoarseBodies, ErrorBarsHoldAndErrorsFallWithDensity) {
  std::array<SweepResult, spheroids.size()> references;
  for (std::size_t i = 0; i < spheroids.size(); ++i)
    references[i] = rows_of(shapes::spheroid(FacetKind::longitudes, spheroids[i][0], spheroids[i][1], 40000), frequencies);
  double coarser = 1e9;
  for (const std::uint32_t facets : {800u, 2400u, 7200u}) {
    Count count;
    for (std::size_t i = 0; i < spheroids.size(); ++i)
      for (const FacetKind kind : kinds)
        compare(rows_of(shapes::spheroid(kind, spheroids[i][0], spheroids[i][1], facets), frequencies), references[i], count);
    measured("covered", static_cast<double>(count.covered) / count.rows, "");
    measured("rms error", rms(count.errors), "dB");
    EXPECT_GE(count.covered, 0.9 * count.rows) << facets;
    EXPECT_LT(rms(count.errors), 0.5 * coarser) << facets;
    coarser = rms(count.errors);
  }
}

TEST(CoarseBodies, ErrorBarsHoldOnCapsules) {
  const SweepResult reference = rows_of(shapes::capsule(0.12, 0.4, 288), frequencies);
  Count count;
  for (const std::uint32_t columns : {36u, 72u, 144u})
    compare(rows_of(shapes::capsule(0.12, 0.4, columns), frequencies), reference, count);
  measured("covered", static_cast<double>(count.covered) / count.rows, "");
  EXPECT_GE(count.covered, 0.9 * count.rows);
}

// Meshes by latitude and longitude near the dents of 1/32 of a wavelength at which facets of one surface used to be curved and
// flat: exact is -5.47 dBsm (Mie). .2 dB leaves room for what asymptotic waves miss at ka 63.
TEST(CoarseBodies, SphereIsRightAtAnyDensity) {
  for (const std::uint32_t n : {23u, 25u, 26u, 27u, 28u, 30u}) {
    Sweep sweep = monostatic(looks, 10e9);
    const SweepResult result = solve_soup(
        shapes::revolution([](double s) { return 0.3 * dvec2(std::sin(pi * s), std::cos(pi * s)); }, shapes::even_rows(n), 2 * n),
        sweep, SolveOptions{});
    for (const ScatteringMatrix& s : result.total) EXPECT_NEAR(dbsm(s.vv()), -5.47, 0.2) << n;
  }
}

}  // namespace
}  // namespace raytube
