// Faces that lie on one another, or almost: what is hidden between them gives nothing.
#include <fmt/format.h>

#include "stress/description.h"
#include "stress/stability.h"

namespace raytube::testing {
namespace {

const double side = 2 * stress_wavelength;

PolygonSoup moved(PolygonSoup soup, const dvec3& shift) {
  for (dvec3& p : soup.points) p += shift;
  return soup;
}

PolygonSoup turned_over(PolygonSoup soup) {
  for (auto& polygon : soup.polygons) std::ranges::reverse(polygon);
  return soup;
}

PolygonSoup with_other_diagonal(PolygonSoup plate) {
  plate.polygons = {{1, 2, 3}, {1, 3, 0}};
  return plate;
}

/// Two parts a gap apart, and what they are without one.
struct Pair {
  std::string name;
  PolygonSoup whole;
  std::function<PolygonSoup(double gap)> parts;
};

Pair boxes() {
  return {"two boxes side by side", shapes::box({2 * side, side, side}), [](double gap) {
            const dvec3 aside((side + gap) / 2, 0, 0);
            return shapes::joined(moved(shapes::cube(side), -aside), moved(shapes::cube(side), aside));
          }};
}

Pair cube_on_block() {
  return {"cube on a wider block", interaction::cube_on_block(2 * side, side / 2, side), [](double gap) {
            const PolygonSoup block = moved(shapes::box({2 * side, 2 * side, side / 2}), {0, 0, -side / 4});
            return shapes::joined(block, moved(shapes::cube(side), {0, 0, side / 2 + gap}));
          }};
}

Pair plate_on_plate() {
  const PolygonSoup plate = shapes::plate(2 * side);
  return {"plate on a wider plate", plate, [=](double gap) {
            return shapes::joined(plate, moved(shapes::plate(side, 0.3), {0, 0, gap}));
          }};
}

Pair double_sheet(const std::string& name, const PolygonSoup& other) {
  const PolygonSoup plate = shapes::plate(2 * side);
  return {name, plate, [=](double gap) { return shapes::joined(plate, moved(other, {0, 0, gap})); }};
}

std::vector<Pair> double_sheets() {
  const PolygonSoup plate = shapes::plate(2 * side);
  return {double_sheet("plate twice", plate), double_sheet("plate from both sides", turned_over(plate)),
          double_sheet("plate, other diagonal", with_other_diagonal(plate)),
          double_sheet("plate from both sides, other diagonal", turned_over(with_other_diagonal(plate)))};
}

double worst_at_gap(const Pair& pair, double gap, const std::vector<NamedOptions>& options) {
  const glm::dmat3 turn = random_rotation(9, 0);
  const auto apart = [&](Description d, int) {
    d.soup = shapes::transformed(pair.parts(gap), turn);
    return Change{std::move(d)};
  };
  return worst_of_changes({{pair.name, shapes::transformed(pair.whole, turn)}}, options, general_looks(), 1, apart);
}

const std::vector<NamedOptions> no_edges = {tubes_and_edges(TubeMode::uniform, 0, false),
                                            tubes_and_edges(TubeMode::adaptive, 0, false)};
const std::vector<NamedOptions> first_order = {tubes_and_edges(TubeMode::uniform, 1, false)};

TEST(Coincident, NothingBetweenThem) {
  double worst = 0.0;
  for (const Pair& pair : {boxes(), cube_on_block(), plate_on_plate()}) worst = worse(worst, worst_at_gap(pair, 0.0, no_edges));
  expect_stable({"gap 0, against the body that both are; no edges",
                 "two boxes side by side, cube on a wider block, plate on a wider plate", worst, 1e-9,
                 "what is seen are the same planes: 1e-14"});
}

TEST(Coincident, SmallGaps) {
  // The upper part is moved by the gap g: phase 2 k g. What it shadows moves by g times the tangent of the look, and the walls of
  // the slit are lit: as much again. All this of parts that are up to twice as large as their sum.
  const double k = 2 * pi / stress_wavelength;
  for (const double gap : {1e-12, 1e-9, 1e-7}) {
    double worst = 0.0;
    for (const Pair& pair : {boxes(), cube_on_block(), plate_on_plate()}) worst = worse(worst, worst_at_gap(pair, gap, no_edges));
    expect_stable({fmt::format("gap {:.0e} m, against none; no edges", gap), "the same", worst, 8 * k * gap,
                   "2 k gap of what is moved, as much of slit and shadow; of parts up to twice their sum"});
  }
  double worst = 0.0;
  for (const Pair& pair : {boxes(), cube_on_block(), plate_on_plate()})
    worst = worse(worst, worst_at_gap(pair, stress_wavelength / 1000, {no_edges[1]}));
  expect_stable({"gap of a thousandth of the wavelength, against none; adaptive, no edges", "the same", worst, 8 * 2 * pi / 1000,
                 "the same"});
}

TEST(Coincident, EdgesOfBodiesThatTouch) {
  expect_stable({"gap 0, edges of order 1", "two boxes side by side, cube on a wider block",
                 std::max(worst_at_gap(boxes(), 0.0, first_order), worst_at_gap(cube_on_block(), 0.0, first_order)), 1e-9,
                 "the inner walls are taken out; edges that lie on another body are in its shadow"});
  expect_stable({"gap 0, all edges", "two boxes side by side", worst_at_gap(boxes(), 0.0, all_options()), 1e-9,
                 "the inner walls are taken out"});
}

TEST(Coincident, DoubleSheetsAreOne) {
  double same_corners = 0.0, all = 0.0;
  for (const double gap : {0.0, 1e-12, 1e-9}) {
    const std::vector<Pair> sheets = double_sheets();
    for (std::size_t i = 0; i < sheets.size(); ++i) {
      if (i < 2) same_corners = std::max(same_corners, worst_at_gap(sheets[i], gap, all_options()));
      all = std::max({all, worst_at_gap(sheets[i], gap, no_edges), worst_at_gap(sheets[i], gap, first_order)});
    }
  }
  expect_stable({"drawn twice, 0 to 1e-9 m apart; all edges", "plate twice, from one side and from both", same_corners, 1e-9,
                 "nearer than the weld distance, 1e-7 D, they are one surface"});
  expect_stable({"the same, triangles cut otherwise too; no edges, and order 1", "the same", all, 1e-9,
                 "the nearest surface counts, the lower triangle where two coincide"});
}

}  // namespace
}  // namespace raytube::testing
