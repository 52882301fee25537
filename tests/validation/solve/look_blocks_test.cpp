// A look is traced in blocks of tiles, between sheets some frequencies at a time: neither changes what it adds up to.
#include <gtest/gtest.h>

#include "validation/material_scene.h"

namespace raytube {

using namespace material_scene;

namespace {

constexpr std::size_t count = 60;  // of frequencies, more than are followed together between sheets

std::vector<double> band(double low, double high) {
  std::vector<double> frequencies;
  for (std::size_t i = 0; i < count; ++i) frequencies.push_back(low + (high - low) * static_cast<double>(i) / (count - 1.0));
  return frequencies;
}

// Ten by ten rectangles, each tilted in its own way.
PolygonSoup tilted_sheets(double side) {
  PolygonSoup soup;
  for (std::uint32_t i = 0; i < 100; ++i) {
    const dvec3 middle(1.3 * side * (i % 10), 1.3 * side * (i / 10), 0.0);
    const double a = 0.02 * (i % 7), b = 0.03 * (i % 5);
    for (const dvec2& corner : {dvec2(0.0, 0.0), dvec2(1.0, 0.0), dvec2(1.0, 1.0), dvec2(0.0, 1.0)})
      soup.points.push_back(middle + side * dvec3(corner, a * corner.x + b * corner.y));
    soup.polygons.push_back({4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3});
  }
  return soup;
}

std::vector<ScatteringMatrix> solved(const std::vector<double>& frequencies, const TubeOptions& tubes) {
  Material laminate = layered(MaterialKind::sheet, {{{{2.6, -0.03}}, 3e-3}});
  laminate.layers.resize(frequencies.size(), laminate.layers[0]);
  PolygonSoup soup = tilted_sheets(0.1);
  soup.materials.assign(soup.polygons.size(), 0);
  const LoadedMesh loaded = build_mesh(soup, 1.0, "test", std::vector{laminate});
  SolveOptions options{tubes, {}, 1, false, {}};
  options.edges.method = EdgeMethod::none;
  const Direction look = deg(80.0, 5.0);
  return solve(Target(loaded.mesh), {frequencies, {{look, look}}, false, {}, {laminate}}, options).total;
}

// With a thousand bounces the sums of 13 tiles at 60 frequencies are kept in eight blocks. Alone the frequency has a block for
// each tile. Sums in another order: some 1e-14.
TEST(LookBlocks, FrequenciesBetweenSheetsAreWhatTheyAreAlone) {
  TubeOptions tubes;
  tubes.max_bounces = 1000;
  const std::vector<double> frequencies = band(5e9, 5.3e9);
  const std::vector<ScatteringMatrix> all = solved(frequencies, tubes);
  for (const std::size_t f : {std::size_t{0}, std::size_t{31}, count - 1})
    EXPECT_LE(difference(all[f], solved({frequencies[f]}, tubes)[0]), 1e-11) << frequencies[f];
}

}  // namespace
}  // namespace raytube
