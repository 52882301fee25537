// The grid three times as coarse that uniform tubes sample on the way: which cells stand for which, and what the difference
// tells.
#include <gtest/gtest.h>

#include "closed_forms.h"
#include "run.h"
#include "sbr/sbr.h"
#include "shapes.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double frequency = 3e9;  // [Hz]

TubeSums tubes(const PolygonSoup& soup, const Direction& look, double per_wavelength) {
  const LoadedMesh loaded = build_mesh(soup, 1.0);
  TubeOptions options;
  options.mode = TubeMode::uniform;
  options.per_wavelength = per_wavelength;
  const double frequencies[] = {frequency};
  Progress progress(nullptr);
  return sbr_scattering({Tracer(loaded.mesh), FaceTree(loaded.mesh)}, {look, look}, frequencies, options, {progress});
}

Complex all_bounces(const TubeSums& sums, int p, int q) {
  Complex sum = 0.0;
  for (const auto& bounce : sums.bounces) sum += bounce.at(0).at(p, q);
  return sum;
}

double largest(const TubeSums& sums) { return std::max(std::abs(all_bounces(sums, 0, 0)), std::abs(all_bounces(sums, 1, 1))); }

// The largest |fine - difference - coarse| of the four amplitudes, relative to the largest amplitude.
double mismatch(const TubeSums& fine, const TubeSums& coarse) {
  double worst = 0.0;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q)
      worst =
          std::max(worst, std::abs(all_bounces(fine, p, q) - fine.coarse.at(0)[0].coherent.at(p, q) - all_bounces(coarse, p, q)));
  return worst / largest(coarse);
}

// A grid of one third of the columns and rows, shot for itself. Its rays leave 0.4 % of a cell away from those of the fine grid:
// none of them falls on another side of an edge here, so what remains is rounding of some thousand terms.
TEST(CoarseGrid, IsTheGridWithAThirdOfTheColumns) {
  const double wave = wavelength(frequency);
  const double plate_cells = 450 * wave / (1.5 * std::numbers::sqrt2);  // 450 x 450 cells, many tiles
  const PolygonSoup plate = shapes::plate(1.5, 45 * degree);
  EXPECT_LE(mismatch(tubes(plate, {0.0, 0.0}, plate_cells), tubes(plate, {0.0, 0.0}, plate_cells / 3)), 1e-12);

  // Seen at the azimuth where sin + cos = 1.2 the dihedral is 1.2 m wide: 108 x 90 cells, the fold inside one.
  const Direction into_dihedral{90 * degree, 0.5 * std::asin(0.44)};
  const TubeSums fine = tubes(shapes::dihedral(1.0, 1.0), into_dihedral, 90 * wave);
  EXPECT_EQ(fine.bounces.size(), 2u);
  EXPECT_LE(mismatch(fine, tubes(shapes::dihedral(1.0, 1.0), into_dihedral, 30 * wave)), 1e-12);
}

// Where the grid is no multiple of three the last group is what remains. A plate that fills the grid has no discontinuity, so
// both grids are exact and the difference is rounding; a cell that was left out or taken twice would show as 1/50.
TEST(CoarseGrid, CoversTheLastColumnsAndRowsToo) {
  for (const double side : {1.5, 1.51, 1.52, 1.53, 1.54})  // 150 to 154 cells: remainders 0, 1, 2
    for (const Direction& look : {Direction{0.0, 0.0}, Direction{0.3, 0.0}}) {
      const TubeSums sums = tubes(shapes::plate(side), look, wavelength(frequency) * 100);
      EXPECT_LE(std::abs(sums.coarse.at(0)[0].coherent.vv()), 1e-12 * 1.5 * 1.5 / wavelength(frequency)) << side;
    }
}

// Squares are taken tile by tile and added up: of one tile, that of the sum.
TEST(CoarseGrid, SquaresAreThoseOfTheTiles) {
  const TubeSums tile = tubes(shapes::plate(0.5, 33 * degree), {0.2, 0.4}, 2.0);
  TubeSums two = tile;
  two.add(tile);
  for (int p = 0; p < 2; ++p) {
    const double square = std::norm(tile.coarse.at(0)[0].coherent.at(p, p));
    EXPECT_GT(square, 0.0);
    EXPECT_EQ(tile.coarse.at(0)[0].squares[p][p], square);
    EXPECT_EQ(two.coarse.at(0)[0].squares[p][p], 2.0 * square);
    EXPECT_EQ(two.coarse.at(0)[0].coherent.at(p, p), 2.0 * tile.coarse.at(0)[0].coherent.at(p, p));
  }
}

TEST(CoarseGrid, AdaptiveTubesSampleNone) {
  const LoadedMesh loaded = build_mesh(shapes::plate(1.0), 1.0);
  TubeOptions options;
  options.mode = TubeMode::adaptive;
  Progress progress(nullptr);
  const double frequencies[] = {frequency};
  EXPECT_TRUE(sbr_scattering({Tracer(loaded.mesh), FaceTree(loaded.mesh)}, {{0, 0}, {0, 0}}, frequencies, options, {progress})
                  .coarse.empty());
}

// On a plate turned against the grid the difference is nearly the coarse grid's whole error: the fine grid's own is several times
// smaller (its staircase has a third of the step). The factor 2 is that share and the chance in a median of 40 looks.
TEST(CoarseGrid, DifferenceIsTheSizeOfTheCoarseError) {
  const double turn = 33 * degree, k = wavenumber(frequency);
  std::vector<double> ratios;
  for (int i = 0; i < 40; ++i) {
    const Direction look{(2 + 1.5 * i) * degree, 20 * degree};
    const TubeSums sums = tubes(shapes::plate(1.5, turn), look, 10.0);
    const Complex difference = sums.coarse.at(0)[0].coherent.vv(), coarse = all_bounces(sums, 0, 0) - difference;
    ratios.push_back(std::abs(difference) / std::abs(coarse - closed_forms::plate(1.5, k, look, turn)));
  }
  measured("difference of the grids / error of the coarse one, median", quantile(ratios, 0.5), "");
  EXPECT_GE(quantile(ratios, 0.5), 0.5);
  EXPECT_LE(quantile(ratios, 0.5), 2.0);
}

}  // namespace
}  // namespace raytube
