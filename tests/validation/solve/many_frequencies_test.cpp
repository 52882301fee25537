// Many frequencies from a few nodes give what each frequency gives for itself.
#include <gtest/gtest.h>

#include "run.h"
#include "sbr/sbr.h"
#include "shapes.h"

namespace raytube {
namespace {

using namespace raytube::testing;

std::vector<double> evenly(double low, double high, int count) {
  std::vector<double> frequencies;
  for (int i = 0; i < count; ++i) frequencies.push_back(low + (high - low) * i / (count - 1));
  return frequencies;
}

TubeSums tubes(const LoadedMesh& loaded, const Direction& look, const std::vector<double>& frequencies) {
  Progress progress(nullptr);
  TubeOptions options;
  options.mode = TubeMode::uniform;
  return sbr_scattering({Tracer(loaded.mesh), FaceTree(loaded.mesh)}, {look, look}, frequencies, options, {progress});
}

double largest(const ScatteringMatrix& s) {
  return std::max({std::abs(s.vv()), std::abs(s.vh()), std::abs(s.hv()), std::abs(s.hh())});
}

double difference(const ScatteringMatrix& a, const ScatteringMatrix& b) {
  double worst = 0.0;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) worst = std::max(worst, std::abs(a.at(p, q) - b.at(p, q)));
  return worst;
}

// Every tenth frequency of a sweep of 101 against a sweep of that one and the highest, which sets the grid, relative to the
// largest amplitude of the sweep. `of(sums, f)` picks what is compared.
template <class Quantity>
double worst_difference(const PolygonSoup& soup, const Direction& look, const std::vector<double>& frequencies, Quantity of) {
  const LoadedMesh loaded = build_mesh(PolygonSoup(soup), 1.0);
  const TubeSums all = tubes(loaded, look, frequencies);
  double scale = 0.0, worst = 0.0;
  for (std::size_t f = 0; f < frequencies.size(); ++f) scale = std::max(scale, largest(of(all, f)));
  for (std::size_t f = 0; f < frequencies.size(); f += 10) {
    const TubeSums direct = tubes(loaded, look, {frequencies[f], frequencies.back()});
    worst = std::max(worst, difference(of(all, f), of(direct, 0)));
  }
  return worst / scale;
}

ScatteringMatrix bounces(const TubeSums& sums, std::size_t f) {
  ScatteringMatrix sum;
  for (const auto& bounce : sums.bounces) sum += bounce[f];
  return sum;
}

ScatteringMatrix coarse(const TubeSums& sums, std::size_t f) { return sums.coarse[f][0].coherent; }

struct Scene {
  PolygonSoup soup;
  Direction look;
};

std::vector<Scene> scenes() {
  return {{shapes::plate(0.6, 20 * degree), {0.4, 0.3}},
          {shapes::dihedral(0.5, 0.4), {80 * degree, 31 * degree}},
          {shapes::trihedral(0.5), {50 * degree, 40 * degree}},
          {shapes::icosphere(3, 0.3), {1.0, 0.5}}};
}

// Each tile is interpolated to 1e-12 of what it would give in phase; with the tiles of these targets out of phase by less than a
// factor of ten altogether, few bits remain to be lost.
TEST(ManyFrequencies, AreWhatEachOneGives) {
  for (const auto& [low, high] : {std::pair{9.8e9, 10e9}, std::pair{5e9, 10e9}})
    for (const Scene& target : scenes()) {
      EXPECT_LE(worst_difference(target.soup, target.look, evenly(low, high, 101), bounces), 1e-12) << low;
      EXPECT_LE(worst_difference(target.soup, target.look, evenly(low, high, 101), coarse), 1e-11) << low;
    }
}

// With few frequencies nothing is interpolated: neighbours in a list do not touch one another's bits.
TEST(ManyFrequencies, AFewAreComputedOneByOne) {
  const LoadedMesh loaded = build_mesh(shapes::dihedral(0.5, 0.4), 1.0);
  const Direction look{80 * degree, 31 * degree};
  const TubeSums seven = tubes(loaded, look, evenly(9.8e9, 10e9, 7)), one = tubes(loaded, look, {10e9});
  for (std::size_t b = 0; b < 2; ++b)
    for (int p = 0; p < 2; ++p) EXPECT_EQ(seven.bounces.at(b)[6].at(p, p), one.bounces.at(b)[0].at(p, p));
}

// The edge pass alone: hardly any tubes. Waves are interpolated to 1e-6 of the sum of their amplitudes at most, with what is met
// a hundredth of that (math/path_bins); strips of these bodies are out of phase by less than a factor of ten altogether.
TEST(ManyFrequencies, OfTheEdgePassAreWhatEachOneGives) {
  SolveOptions o = options(EdgeMethod::fringe, 0.1);
  for (const auto& [low, high] : {std::pair{9.8e9, 10e9}, std::pair{5e9, 10e9}})
    for (const PolygonSoup& soup : {shapes::cube(0.2), shapes::dihedral(0.3, 0.2), shapes::plate(0.2, 0.3)}) {
      const LoadedMesh loaded = build_mesh(PolygonSoup(soup), 1.0);
      const Target target(loaded.mesh);
      const std::vector<double> frequencies = evenly(low, high, 101);
      const Look look{{1.2, 0.4}, {1.1, 0.7}};
      const SweepResult all = solve(target, {frequencies, {look}, true}, o);
      double scale = 0.0, worst = 0.0;
      for (std::size_t f = 0; f < 101; ++f)
        scale = std::max(scale, largest(all.of("edges_order_1")[f] + all.of("edges_order_2_on")[f]));
      for (std::size_t f = 0; f < 101; f += 10) {
        const SweepResult direct = solve(target, {{frequencies[f], high}, {look}, true}, o);
        worst = std::max({worst, difference(all.of("edges_order_1")[f], direct.of("edges_order_1")[0]),
                          difference(all.of("edges_order_2_on")[f], direct.of("edges_order_2_on")[0])});
      }
      EXPECT_GT(scale, 0.0);
      EXPECT_LE(worst, 1e-7 * scale) << low;
    }
}

// What is missing at a frequency, by itself and in a sweep with another one. Estimates are a share of what is computed, which
// differs by its numerical error at most: the strongest row of a look says how exact the quadrature of interaction has to be.
void expect_same_model(const PolygonSoup& soup, const std::vector<double>& frequencies, const SolveOptions& how) {
  const Target target(build_mesh(PolygonSoup(soup), 1.0).mesh);
  Sweep sweep = monostatic({{80 * degree, 31 * degree}, {70 * degree, 45 * degree}}, frequencies[0]);
  sweep.frequencies = frequencies;
  const SweepResult all = solve(target, sweep, how);
  for (std::size_t f = 0; f < frequencies.size(); ++f) {
    sweep.frequencies = {frequencies[f]};
    const SweepResult one = solve(target, sweep, how);
    for (std::size_t look = 0; look < sweep.looks.size(); ++look)
      for (const int p : {0, 1}) {
        const std::size_t row = look * frequencies.size() + f;
        const double model = one.model[look][p][p], error = all.error[row][p][p] + one.error[look][p][p];
        EXPECT_NEAR(all.model[row][p][p], model, error + 1e-9 * model) << frequencies[f] << ' ' << look;
      }
  }
}

// At 0.3 GHz no edge of the dihedral is a wavelength long, so none illuminates the other face; at 5 GHz they do.
TEST(ManyFrequencies, MissWhatEachOneMissesWhereSomeHaveNoInteraction) {
  SolveOptions how;
  how.edges.interaction = true;
  expect_same_model(shapes::dihedral(0.5, 0.4), {0.3e9, 5e9}, how);
}

}  // namespace
}  // namespace raytube
