// Images of looks: what they add up to, and where things are in them.
#include "solve/image.h"

#include <gtest/gtest.h>

#include "run.h"
#include "shapes.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double frequency = 3e9;

ScatteringMatrix sum_of(std::span<const ScatteringMatrix> parts) {
  ScatteringMatrix sum;
  for (const ScatteringMatrix& s : parts) sum += s;
  return sum;
}

ScatteringMatrix sum_of(std::span<const ImageEdge> pieces) {
  ScatteringMatrix sum;
  for (const ImageEdge& piece : pieces) sum += piece.s;
  return sum;
}

struct Solved {
  Solved(PolygonSoup soup, const Sweep& sweep, const SolveOptions& o, std::size_t look, double per_wavelength = 10.0)
      : loaded(build_mesh(std::move(soup), 1.0)), target(loaded.mesh), result(solve(target, sweep, o)) {
    image = image_of_look(target, sweep, o, look, per_wavelength);
    row = result.total[sweep.row(look, image_frequency(sweep))];
  }
  LoadedMesh loaded;
  Target target;
  SweepResult result;
  LookImage image;
  ScatteringMatrix row;
};

// Both ways of dividing S, by launch cells and by what carries the currents, leave nothing out and count nothing twice.
void expect_sums(const Solved& s, double tolerance, const char* what) {
  const double size = frobenius_norm(s.row);
  const double by_cells = frobenius_norm(sum_of(s.image.cells) - s.row) / size;
  const double by_place = frobenius_norm(sum_of(s.image.triangles) + sum_of(s.image.edges) - s.row) / size;
  std::printf("measured: %s: cells %.2g, triangles and edges %.2g of |S|\n", what, by_cells, by_place);
  EXPECT_LE(by_cells, tolerance) << what;
  EXPECT_LE(by_place, tolerance) << what;
}

SolveOptions adaptive(EdgeMethod edges, int order = 3) {
  SolveOptions o = options(edges);
  o.tubes.mode = TubeMode::adaptive;
  o.edges.order = order;
  return o;
}

// A sum of some thousand parts up to some hundred times as large as it: 1e-16 each, at random.
constexpr double rounding = 1e-12;

Sweep one_look(const Direction& d) { return monostatic({d}, frequency); }

TEST(Image, CellsAddUpToTheRow) {
  const Direction aside{70.0 * degree, 33.0 * degree};
  expect_sums({shapes::plate(1.0, 0.3), one_look({20.0 * degree, 33.0 * degree}), adaptive(EdgeMethod::none), 0}, rounding,
              "plate");
  expect_sums({shapes::dihedral(0.8, 1.0), one_look(aside), adaptive(EdgeMethod::none), 0}, rounding, "dihedral, adaptive");
  expect_sums({shapes::dihedral(0.8, 1.0), one_look(aside), options(EdgeMethod::none), 0}, rounding, "dihedral, uniform");
  expect_sums({shapes::trihedral(0.8), one_look(aside), adaptive(EdgeMethod::none), 0, 7.3}, rounding, "trihedral");
}

TEST(Image, EdgesAddUpToTheRow) {
  const Direction aside{70.0 * degree, 33.0 * degree};
  expect_sums({shapes::cube(0.4), one_look(aside), adaptive(EdgeMethod::fringe, 1), 0}, rounding, "cube, order 1");
  expect_sums({shapes::cube(0.4), one_look(aside), adaptive(EdgeMethod::fringe, 3), 0}, rounding, "cube, order 3");
  expect_sums({shapes::dihedral(0.3, 0.4), one_look(aside), adaptive(EdgeMethod::fringe, 3), 0}, rounding,
              "dihedral, waves between");
}

// Rims as half planes, with the currents of their thickness.
TEST(Image, ThinSheetsAddUpToTheRow) {
  const Sweep sweep = one_look({50.0 * degree, 33.0 * degree});
  for (const int order : {1, 3})
    expect_sums({shapes::box({0.4, 0.3, 0.002}), sweep, adaptive(EdgeMethod::fringe, order), 0}, rounding,
                "sheet of lambda / 50");
}

TEST(Image, ReflectingCurvedSurfacesAddUpToTheRow) {
  PolygonSoup soup = shapes::icosphere(3, 0.3);
  const PolygonSoup other = shapes::transformed(soup, glm::dmat3(1.0), 1.0, {0.2, 0.7, 0.1});
  soup = shapes::joined(soup, other);
  SolveOptions o = adaptive(EdgeMethod::none);
  o.tubes.curved = CurvedSurfaces::always;
  o.tubes.max_bounces = 3;
  expect_sums({soup, one_look({70.0 * degree, 33.0 * degree}), o, 0}, rounding, "two spheres");
}

TEST(Image, CurvedSurfacesAddUpToTheRow) {
  const Sweep sweep = one_look({70.0 * degree, 33.0 * degree});
  expect_sums({shapes::icosphere(4, 0.5), sweep, adaptive(EdgeMethod::none), 0}, rounding, "sphere");
  expect_sums({shapes::cylinder(0.2, 0.6, 72), sweep, adaptive(EdgeMethod::fringe), 0}, rounding, "cylinder");
}

// Many frequencies are interpolated in the row, to 1e-12 of what the tubes would give in phase; the mesh lies far from the
// origin, the sweep is bistatic and the lattice turned.
TEST(Image, AddsUpForAnySweep) {
  Sweep sweep{{}, {}, true};
  for (int i = 0; i < 60; ++i) sweep.frequencies.push_back(2.8e9 + 8e6 * i);
  sweep.looks = {{{0.4, 0.3}, {0.9, 1.0}}, {{1.2, 0.5}, {1.0, 0.2}}};
  SolveOptions o = adaptive(EdgeMethod::fringe);
  o.tubes.up = dvec3(0.3, 0.2, 1.0);
  const PolygonSoup soup = shapes::transformed(shapes::cube(0.4), glm::dmat3(1.0), 1.0, {5.0, -3.0, 2.0});
  const Solved cube(soup, sweep, o, 1, 6.0);
  EXPECT_EQ(cube.image.frequency, sweep.frequencies[30]);
  expect_sums(cube, 1e-11, "cube, bistatic, 60 frequencies");
  const ImageLattice& lattice = cube.image.lattice;
  for (const dvec3& corner : soup.points) {
    const dvec2 inside = (lattice.project(corner) - lattice.corner) / lattice.cell;
    EXPECT_GE(std::min(inside.x, inside.y), -1e-9);
    EXPECT_LE(std::max(inside.x - lattice.columns, inside.y - lattice.rows), 1e-9);
  }
}

TEST(Image, MirroredLooksAddUpToo) {
  const Sweep sweep = monostatic({{90.0 * degree, -17.0 * degree}, {90.0 * degree, 17.0 * degree}}, frequency);
  expect_sums({shapes::cube(0.4), sweep, adaptive(EdgeMethod::fringe), 1}, rounding, "cube, look known from its mirror image");
}

dvec3 loaded_middle(const TriangleMesh& mesh, std::size_t triangle) {
  dvec3 sum = 3.0 * mesh.center;
  for (const std::uint32_t corner : mesh.triangles[triangle]) sum += mesh.vertices[corner];
  return sum / 3.0;
}

double cell_area(const LookImage& image) { return image.lattice.cell.x * image.lattice.cell.y; }

// Face-on every current has the same phase: |S| of a cell is its area / lambda.
TEST(Image, FaceOnEveryCellIsAlike) {
  const Solved plate(shapes::plate(1.0), one_look({0.0, 0.0}), adaptive(EdgeMethod::none), 0);
  ASSERT_EQ(plate.image.lattice.columns, 101u);  // 10 m / lambda, and a little more
  for (const ScatteringMatrix& s : plate.image.cells)
    EXPECT_NEAR(std::abs(s.vv()) * wavelength(frequency) / cell_area(plate.image), 1.0, 1e-12);  // rounding of 100 lines
}

// On the bisector light that met both faces has one phase all over the aperture, whichever face it met first, and is in the cell
// it set out from.
TEST(Image, DoubleBounceIsOnBothHalves) {
  const LoadedMesh loaded = build_mesh(shapes::dihedral(0.8, 1.0), 1.0);
  SolveOptions o = adaptive(EdgeMethod::none);
  const Target target(loaded.mesh);
  const Sweep sweep = one_look({90.0 * degree, 45.0 * degree});
  const LookImage both = image_of_look(target, sweep, o, 0, 5.0);
  o.tubes.max_bounces = 1;
  const LookImage single = image_of_look(target, sweep, o, 0, 5.0);
  const Complex first = both.cells[0].vv() - single.cells[0].vv();
  for (std::size_t i = 0; i < both.cells.size(); ++i) {
    const Complex second_bounce = both.cells[i].vv() - single.cells[i].vv();
    EXPECT_NEAR(std::abs(second_bounce) * wavelength(frequency) / cell_area(both), 1.0, 1e-11);  // phases of 200 rad, cut small
    EXPECT_NEAR(std::abs(second_bounce - first) * wavelength(frequency) / cell_area(both), 0.0, 1e-10);
  }
}

// A face of the cube, seen face-on: its edges are on the rim of the rectangle, and there alone.
TEST(Image, EdgesAreWhereTheyStand) {
  const LoadedMesh loaded = build_mesh(shapes::cube(0.4), 1.0);
  SolveOptions o = adaptive(EdgeMethod::fringe, 1);
  const Target target(loaded.mesh);
  const Sweep sweep = one_look({90.0 * degree, 0.0});
  const LookImage with = image_of_look(target, sweep, o, 0, 10.0);
  o.edges.method = EdgeMethod::none;
  const LookImage without = image_of_look(target, sweep, o, 0, 10.0);
  const ImageLattice& lattice = with.lattice;
  ASSERT_FALSE(with.edges.empty());
  for (std::uint32_t row = 0; row < lattice.rows; ++row)
    for (std::uint32_t column = 0; column < lattice.columns; ++column) {
      const bool rim = row == 0 || column == 0 || row + 1 == lattice.rows || column + 1 == lattice.columns;
      const std::size_t i = lattice.index({column, row});
      const double added = largest_amplitude(with.cells[i] - without.cells[i]);
      EXPECT_EQ(added > 0.0, rim);
    }
  for (const ImageEdge& piece : with.edges)
    EXPECT_NEAR(std::max(std::abs(piece.begin.y), std::abs(piece.begin.z)), 0.2, 1e-12);  // rounding of the coordinates
}

// Two plates side by side along y, one facing the radar, the other turned by 35 degrees: cells of a wavelength and more are
// brightest on the former, whose currents alone have one phase; on the latter a cell of 2 lambda spans 4 sin 35 lambda of path.
TEST(Image, BrightestWhereThePlateFacesTheRadar) {
  const glm::dmat3 turn(std::cos(0.6), 0.0, -std::sin(0.6), 0.0, 1.0, 0.0, std::sin(0.6), 0.0, std::cos(0.6));
  const PolygonSoup other = shapes::transformed(shapes::plate(1.4), turn, 1.0, {0.0, 2.0, 0.0});
  const Solved plates(shapes::joined(shapes::plate(1.0), other), one_look({0.0, 0.0}), adaptive(EdgeMethod::none), 0, 0.5);
  const auto power = [](const ScatteringMatrix& s) { return std::abs(s.vv()); };
  const auto brightest = std::ranges::max_element(plates.image.cells, {}, power) - plates.image.cells.begin();
  const ImageLattice& lattice = plates.image.lattice;
  const auto columns = static_cast<std::ptrdiff_t>(lattice.columns);
  const dvec2 place = lattice.middle({brightest % columns, brightest / columns});
  const dvec3 at = place.x * lattice.u_hat + place.y * lattice.v_hat;
  EXPECT_LT(std::abs(at.x), 0.5);
  EXPECT_LT(std::abs(at.y), 0.5);
  double on_other = 0.0;
  for (std::size_t t = 0; t < plates.image.triangles.size(); ++t)
    if (loaded_middle(plates.loaded.mesh, t).y > 1.0) on_other += power(plates.image.triangles[t]);
  EXPECT_LT(on_other, 0.1 * power(plates.row));
}

}  // namespace
}  // namespace raytube
