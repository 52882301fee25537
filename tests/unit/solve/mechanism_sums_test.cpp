// Mechanisms have rows, pieces and counts of their own, which add up.
#include <gtest/gtest.h>

#include <map>

#include "imaging/centres.h"
#include "plan/mechanism.h"
#include "run.h"
#include "smooth_bodies.h"
#include "solve/image.h"
#include "solve/pieces.h"
#include "validation/material_scene.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double frequency = speed_of_light;  // of one metre
constexpr double rounding = 1e-12;            // of a sum of some thousand parts up to some hundred times as large as it
const std::vector<std::string> of_curved_surfaces{"surface_waves", "rounded_edges", "flat_tips", "round_tips"};

// A leaf, whose rims are narrow and meet in flat tips, beside an ogive.
struct LeafAndOgive {
  LeafAndOgive() {
    options.keep_parts = true;
    options.surfaces.waves = true;
  }

  static PolygonSoup soup() {
    PolygonSoup ogive = shapes::spindle(22.6 * degree, 5.0, 1.0);
    for (dvec3& p : ogive.points) p.y += 6.0;
    return shapes::joined(shapes::spindle(25 * degree, 4.0, 1.0 / 3), ogive);
  }
  SweepResult solved() const { return solve(target, sweep, options); }

  Target target{build_mesh(soup(), 1.0).mesh};
  Sweep sweep = monostatic({{90 * degree, 8 * degree}, {75 * degree, 20 * degree}}, frequency);
  SolveOptions options;
};

// Columns to the row, in every row, and cells of its image in the first one.
void expect_rows(const Target& target, const Sweep& sweep, const SolveOptions& options, const SweepResult& result) {
  for (std::size_t row = 0; row < sweep.rows(); ++row) {
    ScatteringMatrix rest = result.total[row];
    for (const std::vector<ScatteringMatrix>& bounce : result.bounces) rest = rest - bounce[row];
    for (const MechanismRows& part : result.mechanisms) rest = rest - part.rows[row];
    EXPECT_LE(frobenius_norm(rest), rounding * frobenius_norm(result.total[row]));
  }
  const LookImage image = image_of_look(target, sweep, options, 0, 10.0);
  ScatteringMatrix cells;
  for (const ScatteringMatrix& s : image.cells) cells += s;
  EXPECT_LE(frobenius_norm(cells - result.total[0]), rounding * frobenius_norm(result.total[0]));
}

// The same, in the first row pieces to their columns, and centres to the row.
void expect_sums(const Target& target, const Sweep& sweep, const SolveOptions& options, const SweepResult& result,
                 const std::vector<std::string>& columns) {
  expect_rows(target, sweep, options, result);
  const std::vector<std::string> names = piece_names(mechanism_list());
  std::map<std::string, ScatteringMatrix> sums;
  std::vector<ScatteringPiece> pieces;
  scattering_pieces(target, sweep, 0, frequency, options, 0.1, [&](const ScatteringPiece& piece) {
    sums[names[piece.mechanism]] += piece.s;
    pieces.push_back(piece);
  });
  const double size = frobenius_norm(result.total[0]);
  for (const std::string& name : columns) {
    EXPECT_GT(frobenius_norm(result.of(name)[0]), 1e-4) << name;
    EXPECT_LE(frobenius_norm(sums[name] - result.of(name)[0]), rounding * size) << name;
  }
  const ScatteringCentres found =
      scattering_centres(pieces, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {10, 0.5, wavelength(frequency), names});
  ScatteringMatrix centres = found.rest;
  for (const ScatteringCentre& centre : found.centres) centres += centre.s;
  EXPECT_LE(frobenius_norm(centres - result.total[0]), rounding * size);
}

TEST(Mechanisms, OfCurvedSurfacesAddUp) {
  const LeafAndOgive bodies;
  const SweepResult result = bodies.solved();
  expect_sums(bodies.target, bodies.sweep, bodies.options, result, of_curved_surfaces);
  for (const char* count : {"surface_strips", "rounded_edge_pieces", "flat_tip_points", "round_tip_sides"})
    EXPECT_GT(result.statistics.counted(count), 0u) << count;
}

// A plate and a cube.
TEST(Mechanisms, OfCornersAddUp) {
  const PolygonSoup cube = shapes::transformed(shapes::cube(1.5), glm::dmat3(1.0), 1.0, {0, 4, 0});
  const Target target(build_mesh(shapes::joined(shapes::plate(1.5), cube), 1.0).mesh);
  const Sweep sweep = monostatic({{60 * degree, 20 * degree}, {75 * degree, 30 * degree}}, frequency);
  SolveOptions options;
  options.keep_parts = true;
  const SweepResult result = solve(target, sweep, options);
  expect_sums(target, sweep, options, result, {"plate_corners", "solid_corners"});
  for (const char* count : {"wedges_lit", "plate_corners", "solid_corners"})
    EXPECT_GT(result.statistics.counted(count), 0u) << count;
}

double largest_of_solid_corners(const SweepResult& result) {
  double most = 0.0;
  for (const ScatteringMatrix& s : result.of("solid_corners")) most = std::max({most, std::abs(s.vv()), std::abs(s.hh())});
  return most;
}

// Seen along the normal of a face, 900 square wavelengths, a cube's waves along edges cannot change its row by a tolerance;
// from elsewhere they can. Rows without them are those of a run without them.
TEST(Mechanisms, CornerWavesOfSolidsRunWhereTheyMayChangeARow) {
  const Target cube(build_mesh(shapes::cube(15.0), 1.0).mesh);
  const Sweep sweep = monostatic({{90 * degree, 0.0}, {75 * degree, 30 * degree}, {60 * degree, 20 * degree}}, frequency);
  SolveOptions options;
  options.keep_parts = true;
  const SweepResult result = solve(cube, sweep, options);
  options.edges.corners.solids = false;
  const SweepResult without = solve(cube, sweep, options);
  EXPECT_EQ(result.total[0].vv(), without.total[0].vv());
  EXPECT_EQ(frobenius_norm(result.of("solid_corners")[0]), 0.0);
  for (const std::size_t row : {1, 2}) EXPECT_GT(frobenius_norm(result.of("solid_corners")[row]), 0.0);
}

// Of five equal blocks in a row the waves add up in phase across it, beside a plate that is much stronger in some looks: no row
// is wrong by more than a tolerance where they are left out.
TEST(Mechanisms, CornerWavesOfEqualSolidsInARow) {
  PolygonSoup soup = shapes::transformed(shapes::plate(8.0), glm::dmat3(1.0), 1.0, {0, 0, -20});
  for (int i = 0; i < 5; ++i)
    soup = shapes::joined(
        soup, shapes::transformed(shapes::cube(1.7), glm::dmat3(1.0), 1.0, {-1.5 * i, 3.0 * std::cos(30 * degree) * i, 0}));
  const Target target(build_mesh(std::move(soup), 1.0).mesh);
  std::vector<Direction> looks;
  for (double theta = 0; theta < 90; theta += 6) looks.push_back({theta * degree, 30 * degree});
  SolveOptions options, exact;
  options.keep_parts = exact.keep_parts = true;
  exact.tubes.tolerance_db = 1e-6;
  const SweepResult result = solve(target, monostatic(looks, frequency), options);
  const SweepResult all = solve(target, monostatic(looks, frequency), exact);
  std::size_t left_out = 0;
  for (std::size_t row = 0; row < looks.size(); ++row) {
    if (frobenius_norm(result.of("solid_corners")[row]) > 0.0) continue;
    ++left_out;
    const double most = std::abs(all.of("solid_corners")[row].vv()),
                 tolerance = std::pow(10.0, options.tubes.tolerance_db / 20) - 1;
    EXPECT_LT(most, tolerance * std::abs(result.total[row].vv())) << row;
  }
  EXPECT_GT(left_out, 0u);
  EXPECT_LT(left_out, looks.size());
  EXPECT_GT(largest_of_solid_corners(all), 0.1);  // more than twice what one of them adds
}

TEST(Mechanisms, OfMaterialEdgesAddUp) {
  PolygonSoup soup = shapes::plate(1.5);
  soup.materials.assign(soup.polygons.size(), 0);
  const Material coat = material_scene::layered(MaterialKind::coated, {{{{4.0, -0.1}}, 0.02}});
  const Target target(build_mesh(std::move(soup), 1.0, "test", std::span(&coat, 1)).mesh);
  Sweep sweep = monostatic({{60 * degree, 20 * degree}, {75 * degree, 30 * degree}}, frequency);
  sweep.materials = {coat};
  SolveOptions options;
  options.keep_parts = true;
  const SweepResult result = solve(target, sweep, options);
  expect_rows(target, sweep, options, result);
  for (const char* name : {"material_edges_order_1", "material_edges_order_2_on"})
    EXPECT_GT(frobenius_norm(result.of(name)[0]), 1e-3) << name;
  EXPECT_GT(result.statistics.counted("material_edges_lit"), 0u);
}

TEST(Mechanisms, OfThinEndsAddUp) {
  const Target target(build_mesh(shapes::lens_wing(1.0), 1.0).mesh);
  const Sweep sweep = monostatic({{90 * degree, 70 * degree}}, frequency);
  SolveOptions options;
  options.keep_parts = true;
  expect_sums(target, sweep, options, solve(target, sweep, options), {"thin_ends"});
}

// What follows the waves runs in their rows: in all of them, or in none.
TEST(Mechanisms, BesideWavesRunWhereTheyDo) {
  LeafAndOgive bodies;
  bodies.options.surfaces.waves = {};
  for (const double tolerance_db : {0.1, 1e3}) {
    bodies.options.tubes.tolerance_db = tolerance_db;
    const SweepResult result = bodies.solved();
    for (std::size_t row = 0; row < bodies.sweep.rows(); ++row)
      for (const std::string& name : of_curved_surfaces)
        EXPECT_EQ(frobenius_norm(result.of(name)[row]) > 0.0, tolerance_db < 1.0) << name;
  }
}

TEST(Mechanisms, SayWhyTheyTakeNoPart) {
  LeafAndOgive bodies;
  const auto why_not = [&](const char* name) {
    return SolvePlan(bodies.target, bodies.sweep, bodies.options).state(name).why_not;
  };
  bodies.options.surfaces.round_tips = false;
  EXPECT_EQ(why_not("round_tips"), "surfaces.round_tips is false");
  EXPECT_EQ(why_not("flat_tips"), "");
  bodies.options.surfaces.rounded_edges = false;
  EXPECT_EQ(why_not("flat_tips"), "surfaces.rounded_edges is false");
  bodies.options.surfaces.waves = false;
  EXPECT_EQ(why_not("rounded_edges"), "there are no waves over curved surfaces: surfaces.waves is false");
}

}  // namespace
}  // namespace raytube
