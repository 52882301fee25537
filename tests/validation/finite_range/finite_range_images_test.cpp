// Looks from a finite distance: images add up to S, and are seen in perspective.
#include <gtest/gtest.h>

#include "core/error.h"
#include "run.h"
#include "shapes.h"
#include "solve/image.h"
#include "validation/material_scene.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double frequency = 10e9;
const double lambda = wavelength(frequency);

struct Scene {
  Scene(PolygonSoup soup, EdgeMethod method, const std::vector<Material>& materials = {})
      : loaded(build_mesh(std::move(soup), 1.0, "test", materials)), target(loaded.mesh) {
    options = testing::options(method);
    options.tubes = {};
    options.tubes.max_bounces = 3;
  }
  // In units of 2 D^2 / lambda.
  double range(double far_fields) const {
    const double diameter = 2.0 * target.mesh.radius;
    return far_fields * 2.0 * diameter * diameter / lambda;
  }

  LoadedMesh loaded;
  Target target;
  SolveOptions options;
};

template <class Parts>
ScatteringMatrix sum_of(const Parts& parts) {
  ScatteringMatrix sum;
  for (const auto& part : parts)
    if constexpr (requires { part.begin; })
      sum += part.s;
    else
      sum += part;
  return sum;
}

// Parts are up to some hundred times as large as their sum: 1e-16 each, at random.
void expect_sums(const Scene& scene, const Sweep& sweep, const char* what, double tolerance = 1e-12) {
  const SweepResult result = solve(scene.target, sweep, scene.options);
  for (std::size_t look = 0; look < sweep.looks.size(); ++look) {
    const LookImage image = image_of_look(scene.target, sweep, scene.options, look, 7.3);
    const ScatteringMatrix row = result.total[sweep.row(look, image_frequency(sweep))];
    const double by_cells = frobenius_norm(sum_of(image.cells) - row) / frobenius_norm(row),
                 by_place = frobenius_norm(sum_of(image.triangles) + sum_of(image.edges) - row) / frobenius_norm(row);
    std::printf("measured: %s: cells %.2g, triangles and edges %.2g of |S|\n", what, by_cells, by_place);
    EXPECT_LE(by_cells, tolerance) << what;
    EXPECT_LE(by_place, tolerance) << what;
  }
}

Look near_look(const Direction& transmit, const Direction& receive, double range, double receive_range) {
  return {transmit, receive, range, receive_range};
}
Sweep monostatic_at(const Direction& d, double range) { return {{frequency}, {near_look(d, d, range, range)}, false}; }

const Direction aside{70.0 * degree, 33.0 * degree};

TEST(FiniteRangeImage, CellsAddUpToTheRow) {
  for (const double far_fields : {0.3, 1.0, 1e3}) {
    const auto expect = [&](PolygonSoup soup, EdgeMethod method, const char* what, auto change) {
      Scene scene(std::move(soup), method);
      change(scene.options);
      expect_sums(scene, monostatic_at(aside, scene.range(far_fields)), what);
    };
    const auto as_is = [](SolveOptions&) {};
    expect(shapes::plate(5 * lambda, 0.3), EdgeMethod::none, "plate", as_is);
    expect(shapes::dihedral(4 * lambda, 5 * lambda), EdgeMethod::fringe, "dihedral", as_is);
    expect(shapes::dihedral(4 * lambda, 5 * lambda), EdgeMethod::none, "dihedral, uniform",
           [](SolveOptions& o) { o.tubes.mode = TubeMode::uniform; });
    expect(shapes::cube(4 * lambda), EdgeMethod::fringe, "cube, order 3", as_is);
    expect(shapes::cube(4 * lambda), EdgeMethod::fringe, "cube, order 1", [](SolveOptions& o) { o.edges.order = 1; });
    expect(shapes::box({4 * lambda, 3 * lambda, lambda / 50}), EdgeMethod::fringe, "thin plate", as_is);
    const auto with_waves = [](SolveOptions& o) { o.surfaces.waves = true; };
    expect(shapes::icosphere(3, 3 * lambda), EdgeMethod::none, "sphere", as_is);
    expect(shapes::icosphere(3, 3 * lambda), EdgeMethod::fringe, "sphere with waves", with_waves);
    expect(shapes::cylinder(2 * lambda, 6 * lambda, 72), EdgeMethod::fringe, "cylinder with waves", with_waves);
  }
}

// Several frequencies, apart, patterns, a turned lattice and a mesh that is not about the origin.
TEST(FiniteRangeImage, AddsUpForAnySweep) {
  Scene scene(shapes::transformed(shapes::cube(4 * lambda), glm::dmat3(1.0), 1.0, {0.3, -0.2, 0.1}), EdgeMethod::fringe);
  scene.options.tubes.up = dvec3(0.3, 0.2, 1.0);
  Sweep sweep{{0.98 * frequency, frequency, 1.01 * frequency}, {}, true};
  sweep.looks = {near_look({0.4, 0.3}, {0.9, 1.0}, 2.0, 3.0), near_look({1.2, 0.5}, {1.0, 0.2}, 1.0, 1.5)};
  sweep.radar.pattern.azimuth_beamwidth = sweep.radar.pattern.elevation_beamwidth = 20.0 * degree;
  sweep.radar.aim = {0.3, -0.2, 0.1};
  expect_sums(scene, sweep, "cube, bistatic");
}

struct OfMaterials {
  const char* name;
  PolygonSoup soup;  // with materials
  std::vector<Direction> from;
};

// Glass, of two permittivities from the second frequency on; a coat; a window.
std::vector<Material> materials_at(std::size_t frequencies) {
  std::vector<Material> all{material_scene::half_space({4.0, -0.02}),
                            material_scene::layered(MaterialKind::coated, {{{{3.0, -0.2}}, 3.1e-3}}),
                            material_scene::layered(MaterialKind::sheet, {{{{4.0, -0.1}}, 3e-3}})};
  for (Material& material : all)
    for (std::size_t f = 1; f < frequencies; ++f) {
      std::vector<Layer> layers = material.layers.front();
      layers.front().medium.permittivity += 2.0 * static_cast<double>(f);
      material.layers.push_back(std::move(layers));
    }
  return all;
}

PolygonSoup made_of(PolygonSoup soup, std::uint32_t first, std::uint32_t others) {
  soup.materials.assign(soup.polygons.size(), others);
  soup.materials.front() = first;
  return soup;
}

PolygonSoup half_behind_a_window() {
  PolygonSoup soup = made_of(shapes::plate(5 * lambda), no_index, no_index);
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  for (const dvec2& at : {dvec2(0.0, -0.09), {0.09, -0.09}, {0.09, 0.09}, {0.0, 0.09}})
    soup.points.emplace_back(at.x, at.y, 0.03);
  soup.polygons.push_back({first, first + 1, first + 2, first + 3});
  soup.materials.push_back(2);
  return soup;
}

std::vector<OfMaterials> targets_of_materials() {
  return {
      {"glass plate", made_of(shapes::plate(5 * lambda, 0.3), 0, 0), {{0.03, 0.3}, {0.3, 1.9}}},
      {"glass and coat", made_of(shapes::dihedral(5 * lambda, 5 * lambda), 0, 1), {{88 * degree, 43 * degree}, {pi / 2, 0.4}}},
      {"plate and window", half_behind_a_window(), {{0.05, 0.3}, {0.2, 1.9}}}};
}

TEST(FiniteRangeImage, OfMaterialsAddsUp) {
  std::vector<OfMaterials> targets = targets_of_materials();
  targets.push_back({"coated sphere", made_of(shapes::icosphere(3, 3 * lambda), 1, 1), {aside}});
  for (const std::vector<double>& frequencies : {std::vector{frequency}, {0.9 * frequency, frequency, 1.1 * frequency}})
    for (const TubeMode mode : {TubeMode::adaptive, TubeMode::uniform})
      for (const auto& [name, soup, from] : targets) {
        const std::vector<Material> materials = materials_at(frequencies.size());
        Scene scene(soup, EdgeMethod::none, materials);
        scene.options.tubes.mode = mode;
        Sweep sweep{frequencies, {}, false, {}, materials};
        for (const Direction& d : from) sweep.looks.push_back(near_look(d, d, scene.range(0.3), scene.range(0.3)));
        expect_sums(scene, sweep, name);
      }
}

// Of several frequencies the middle one alone, whose coefficients are not the first one's.
TEST(FiniteRangeImage, OfMaterialsIsOfItsFrequency) {
  const std::vector<double> frequencies{0.999 * frequency, frequency, 1.001 * frequency};
  const std::vector<Material> materials = materials_at(3);
  for (const auto& [name, soup, from] : targets_of_materials()) {
    const Scene scene(soup, EdgeMethod::none, materials);
    const Look look = near_look(from.front(), from.front(), scene.range(0.3), scene.range(0.3));
    const LookImage image = image_of_look(scene.target, {frequencies, {look}, false, {}, materials}, scene.options, 0, 7.3),
                    alone = image_of_look(scene.target, {{frequency}, {look}, false, {}, at_frequency(materials, 1)},
                                          scene.options, 0, 7.3);
    double largest = 0.0, difference = 0.0;
    ASSERT_EQ(image.cells.size(), alone.cells.size());
    for (std::size_t i = 0; i < image.cells.size(); ++i) {
      largest = std::max(largest, frobenius_norm(alone.cells[i]));
      difference = std::max(difference, frobenius_norm(image.cells[i] - alone.cells[i]));
    }
    measured(name, difference / largest, "of the largest cell");
    EXPECT_LT(difference, 1e-3 * largest) << name;
  }
}

// The rectangle holds what the antenna sees and no more; a point is in the cell that `raytube trace` finds there.
TEST(FiniteRangeImage, IsSeenInPerspective) {
  const PolygonSoup soup = shapes::transformed(shapes::cube(0.2), glm::dmat3(1.0), 1.0, {0.3, -0.2, 0.1});
  const Scene scene(soup, EdgeMethod::none);
  const ImageLattice lattice = image_of_look(scene.target, monostatic_at(aside, 1.0), scene.options, 0, 7.3).lattice;
  dvec2 low(1e9), high(-1e9);
  for (const dvec3& corner : soup.points) {
    const dvec2 at = (lattice.project(corner) - lattice.corner) / lattice.cell;
    low = glm::min(low, at), high = glm::max(high, at);
  }
  EXPECT_LE(glm::length(low), 1e-9);
  EXPECT_LE(glm::length(high - dvec2(lattice.columns, lattice.rows)), 1e-9);
  EXPECT_LE(glm::length(lattice.project(dvec3(0.0))), 1e-15);
  // Along a ray nothing moves; a way is cut in its own lengths.
  const dvec3 antenna = spherical_basis(aside).radial, begin{0.25, -0.2, 0.1}, end{0.38, -0.13, 0.05};
  EXPECT_LE(glm::length(lattice.project(begin) - lattice.project(antenna + 0.3 * (begin - antenna))), 1e-12);
  const std::vector<double> shares = lattice.crossings(begin, end);
  ASSERT_GT(shares.size(), 4u);
  for (std::size_t i = 1; i + 1 < shares.size(); ++i) {
    const dvec2 cells = (lattice.project(begin + shares[i] * (end - begin)) - lattice.corner) / lattice.cell;
    EXPECT_LE(std::min(std::abs(cells.x - std::round(cells.x)), std::abs(cells.y - std::round(cells.y))), 1e-9);
  }
}

// The phase left of a cell's waves is that of the whole target at most: FiniteRange.TendsToTheFarField.
TEST(FiniteRangeImage, TendsToTheFarImage) {
  const Scene scene(shapes::dihedral(4 * lambda, 5 * lambda), EdgeMethod::fringe);
  const LookImage far = image_of_look(scene.target, monostatic({aside}, frequency), scene.options, 0, 4.0),
                  near = image_of_look(scene.target, monostatic_at(aside, scene.range(1e4)), scene.options, 0, 4.0);
  ASSERT_EQ(near.cells.size(), far.cells.size());
  double largest = 0.0, difference = 0.0;
  for (std::size_t i = 0; i < far.cells.size(); ++i) {
    largest = std::max(largest, frobenius_norm(far.cells[i]));
    difference = std::max(difference, frobenius_norm(near.cells[i] - far.cells[i]));
  }
  measured("finite range, image at 2 10^4 D^2 / lambda, cells against the far image", difference / largest, "of the largest");
  EXPECT_LT(difference, 1e-3 * largest);
}

}  // namespace
}  // namespace raytube
