// Waves over curved surfaces, rounded edges, flat tips and round tips: each has rows, pieces and counts of its own.
#include <gtest/gtest.h>

#include <map>

#include "imaging/centres.h"
#include "plan/mechanism.h"
#include "run.h"
#include "smooth_bodies.h"
#include "solve/image.h"
#include "solve/pieces.h"

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

TEST(CurvedMechanisms, ColumnsAddUpToTheRow) {
  const LeafAndOgive bodies;
  const SweepResult result = bodies.solved();
  for (std::size_t row = 0; row < bodies.sweep.rows(); ++row) {
    ScatteringMatrix rest = result.total[row];
    for (const std::vector<ScatteringMatrix>& bounce : result.bounces) rest = rest - bounce[row];
    for (const MechanismRows& part : result.mechanisms) rest = rest - part.rows[row];
    EXPECT_LE(frobenius_norm(rest), rounding * frobenius_norm(result.total[row]));
  }
  for (const std::string& name : of_curved_surfaces) EXPECT_GT(frobenius_norm(result.of(name)[0]), 1e-3) << name;
  for (const char* count : {"surface_strips", "rounded_edge_pieces", "flat_tip_points", "round_tip_sides"})
    EXPECT_GT(result.statistics.counted(count), 0u) << count;
}

TEST(CurvedMechanisms, PiecesAddUpToTheirColumns) {
  const LeafAndOgive bodies;
  const SweepResult result = bodies.solved();
  const std::vector<std::string> names = piece_names(mechanism_list());
  std::map<std::string, ScatteringMatrix> sums;
  std::vector<ScatteringPiece> pieces;
  scattering_pieces(bodies.target, bodies.sweep, 0, frequency, bodies.options, 0.1, [&](const ScatteringPiece& piece) {
    sums[names[piece.mechanism]] += piece.s;
    pieces.push_back(piece);
  });
  const double size = frobenius_norm(result.total[0]);
  for (const std::string& name : of_curved_surfaces)
    EXPECT_LE(frobenius_norm(sums[name] - result.of(name)[0]), rounding * size) << name;
  const ScatteringCentres found =
      scattering_centres(pieces, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {10, 0.5, wavelength(frequency), names});
  ScatteringMatrix centres = found.rest;
  for (const ScatteringCentre& centre : found.centres) centres += centre.s;
  EXPECT_LE(frobenius_norm(centres - result.total[0]), rounding * size);
  const LookImage image = image_of_look(bodies.target, bodies.sweep, bodies.options, 0, 10.0);
  ScatteringMatrix cells;
  for (const ScatteringMatrix& s : image.cells) cells += s;
  EXPECT_LE(frobenius_norm(cells - result.total[0]), rounding * size);
}

// What follows the waves runs in their rows: in all of them, or in none.
TEST(CurvedMechanisms, RunWhereWavesDo) {
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

TEST(CurvedMechanisms, SayWhyTheyTakeNoPart) {
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
