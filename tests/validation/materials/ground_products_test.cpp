// Over ground: antennas at a finite distance, images, pieces, rays, and which tubes there are.

#include <gmock/gmock.h>

#include "solve/image.h"
#include "solve/pieces.h"
#include "validation/ground_scene.h"

namespace raytube {
namespace {

using namespace raytube::testing;

const double lambda = wavelength(gigahertz);
const Upright plate{0.02, 0.11, 0.05, 0.19};
const Direction aside{70.0 * degree, 12.0 * degree}, off{55.0 * degree, -21.0 * degree};

Sweep bistatic_at(double range, double receive_range) {
  return {{gigahertz}, {{aside, off, range, receive_range}, {off, aside, range, receive_range}}, true};
}
Sweep monostatic_at(double range) { return {{gigahertz}, {{aside, aside, range, range}, {off, off, range, range}}, false}; }

Ground medium(double height) {
  Ground ground{height, Material()};
  ground.material->kind = MaterialKind::half_space;
  const Layer soil{{Complex(5.0, -0.3), 1.0}, 0.0};
  ground.material->layers = {{soil}, {soil}};
  return ground;
}

double largest(const SweepResult& result) {
  double most = 0.0;
  for (const ScatteringMatrix& s : result.total) most = std::max(most, largest_amplitude(s));
  return most;
}

void expect_same(const SweepResult& a, const SweepResult& b, double tolerance, const char* what) {
  double worst = 0.0;
  for (std::size_t row = 0; row < a.total.size(); ++row)
    worst = std::max(worst, largest_difference(a.total[row], b.total[row]) / largest(b));
  measured(what, worst, "of the largest amplitude");
  EXPECT_LT(worst, tolerance) << what;
}

// Target and mirror image in free space, and both receivers: written down with antennas alone.
TEST(GroundAtADistance, APlateHasTheFieldOfTheImageConstruction) {
  const Sweep sweep = bistatic_at(3.0, 2.0);
  Sweep free = sweep;
  for (const Look& look : sweep.looks)
    free.looks.push_back({look.transmit, {pi - look.receive.theta, look.receive.phi}, look.transmit_range, look.receive_range});
  const Case over = case_over(sweep, {0.0, {}});
  const Target both = target_over_ground(plate.soup(), over);
  const SweepResult result = solve(SolvePlan(both, sweep, options_of(over), over.ground)),
                    apart = solve(both, free, options_of(over));
  for (std::size_t row = 0; row < 2; ++row)
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) {
        const Complex exact = apart.total[row].at(p, q) + (p == 0 ? 1.0 : -1.0) * apart.total[row + 2].at(p, q);
        EXPECT_LT(std::abs(result.total[row].at(p, q) - exact), 1e-9 * largest(result)) << row << p << q;
      }
}

// A true antenna lights the mirror image, or the image of the antenna the plate: patterns, aims, polarisations and heights alike.
TEST(GroundAtADistance, ImagesOfAntennasAreThoseThatTheImageConstructionHas) {
  Sweep sweep = bistatic_at(1.5, 1.2);
  sweep.radar.aim = {0.0, 0.1, 0.3}, sweep.radar.receive_aim = dvec3(0.1, -0.1, 0.05);
  sweep.radar.pattern = {20.0 * degree, 30.0 * degree, {}, {{-40.0 * degree, 40.0 * degree}, {-6.0, 2.0}}};
  expect_same(solve_case(plate.soup(), case_over(sweep, conductor_as_a_medium(0.03))),
              solve_case(plate.soup(), case_over(sweep, {0.03, {}})), 1e-9, "images of antennas");
}

TEST(GroundAtADistance, FarAwayItIsTheFarField) {
  for (const Ground& ground : {Ground{-0.02, {}}, medium(-0.02)}) {
    const double range = 1e4 * 0.3 * 0.3 / lambda;
    Sweep near = monostatic_at(range), far = near;
    for (Look& look : far.looks) look.transmit_range = look.receive_range = std::numeric_limits<double>::infinity();
    const SweepResult a = solve_case(plate.soup(), case_over(near, ground)), b = solve_case(plate.soup(), case_over(far, ground));
    for (std::size_t row = 0; row < 2; ++row)
      for (int p = 0; p < 2; ++p)
        EXPECT_NEAR(dbsm(a.total[row].at(p, p)), dbsm(b.total[row].at(p, p)), 0.01) << row << p << ground.perfect();
  }
}

// Rays are reciprocal by themselves.
TEST(GroundAtADistance, AntennasMayBeExchanged) {
  for (const bool near : {true, false})
    for (const Ground& ground : {Ground{-0.1, {}}, medium(-0.1)}) {
      Sweep sweep = bistatic_at(3.0, 2.0);
      std::swap(sweep.looks[1].transmit_range, sweep.looks[1].receive_range);
      if (!near)
        for (Look& look : sweep.looks) look.transmit_range = look.receive_range = std::numeric_limits<double>::infinity();
      const SweepResult rays =
          solve_case(moved(shapes::box({0.1, 0.15, 0.08}), {0, 0, 0.1}), case_over(sweep, ground, EdgeMethod::utd));
      EXPECT_GT(largest(rays), 0.0);
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q)
          EXPECT_LT(std::abs(rays.total[0].at(p, q) - rays.total[1].at(q, p)), 1e-9 * largest(rays)) << near << p << q;
    }
}

TEST(GroundAtADistance, RaysOverAMediumThatConductsAreThoseOverAConductor) {
  Sweep sweep = bistatic_at(std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
  const auto rays = [&](const Ground& ground) {
    Case c = case_over(sweep, ground, EdgeMethod::utd);
    c.edges.utd_range = 50.0;
    return solve_case(plate.soup(), c);
  };
  expect_same(rays(conductor_as_a_medium(0.03)), rays({0.03, {}}), 1e-9, "rays over a medium that conducts");
}

TEST(GroundAtADistance, ATurntableIsAsGoodAsMovingAntennas) {
  Sweep table = monostatic_at(1.5);
  table.radar.aim = {0.05, 0.1, 0.1};
  table.radar.pattern.azimuth_beamwidth = table.radar.pattern.elevation_beamwidth = 12.0 * degree;
  Sweep moving = table;
  moving.radar.aim = seen_from_turntable(table.radar.aim, 0.4);
  for (Look& look : table.looks) look.turn = 0.4;
  for (const Ground& ground : {Ground{0.0, {}}, medium(0.0)})
    expect_same(solve_case(plate.soup(), case_over(table, ground)), solve_case(plate.soup(), case_over(moving, ground)), 1e-12,
                "turntable over ground");
}

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

// Parts are up to some hundred times as large as their sum.
TEST(GroundImage, CellsAddUpToTheRow) {
  const PolygonSoup soup = moved(shapes::box({0.1, 0.15, 0.08}), {0.02, 0, 0.06});
  for (const double range : {3.0, std::numeric_limits<double>::infinity()})
    for (const Ground& ground : {Ground{0.0, {}}, medium(-0.03)})
      for (const bool up : {false, true}) {
        Case c = case_over(monostatic_at(range), ground, EdgeMethod::fringe);
        if (up) c.tubes.up = dvec3(0.3, 0.2, 1.0);
        const Target target = target_over_ground(soup, c);
        const SolvePlan plan(target, c.sweep, options_of(c), c.ground);
        const ScatteringMatrix s = solve(plan).total[1];
        const LookImage image = image_of_look(plan, 1, 4.3);
        EXPECT_LT(largest_difference(sum_of(image.cells), s), 1e-12 * largest_amplitude(s)) << range << ground.perfect();
        EXPECT_LT(largest_difference(sum_of(image.triangles) + sum_of(image.edges), s), 1e-12 * largest_amplitude(s));
        EXPECT_EQ(image.look, 1u);
      }
}

// What the ground lights is seen below the plate, as over a conductor, in the same cells.
TEST(GroundImage, OverAMediumThatConductsItIsThatOverAConductor) {
  const auto image_over = [](const Ground& ground) {
    const Case c = case_over(monostatic({off}, gigahertz), ground);
    const Target target = target_over_ground(plate.soup(), c);
    return image_of_look(SolvePlan(target, c.sweep, options_of(c), c.ground), 0, 4.3);
  };
  const LookImage exact = image_over({0.03, {}}), four = image_over(conductor_as_a_medium(0.03));
  ASSERT_EQ(exact.cells.size(), four.cells.size());
  double most = 0.0, worst = 0.0;
  for (std::size_t i = 0; i < exact.cells.size(); ++i)
    most = std::max(most, largest_amplitude(exact.cells[i])),
    worst = std::max(worst, largest_difference(exact.cells[i], four.cells[i]));
  EXPECT_LT(worst, 1e-9 * most);
}

// From nearby cells of the mirror image are seen in another size: the brightest are as bright all the same.
TEST(GroundImage, OverAMediumThatConductsItIsAsBrightFromNearby) {
  const auto brightest = [](const Ground& ground) {
    const Case c = case_over({{gigahertz}, {{off, off, 1.5, 1.5}}, false}, ground);
    const Target target = target_over_ground(plate.soup(), c);
    double most = 0.0;
    for (const ScatteringMatrix& s : image_of_look(SolvePlan(target, c.sweep, options_of(c), c.ground), 0, 4.3).cells)
      most = std::max(most, largest_amplitude(s));
    return most;
  };
  EXPECT_NEAR(brightest(conductor_as_a_medium(0.03)) / brightest({0.03, {}}), 1.0, 0.12);
}

// Their phases tell of other frequencies: of a plate without edges all has a place, straight, on the ground and below it.
TEST(GroundPieces, AddUpToTheRowAndTellOfOtherFrequencies) {
  const Case c = case_over(monostatic({off}, gigahertz), {0.03, {}});
  const Target target = target_over_ground(plate.soup(), c);
  const double beside = 1.02, dk = (beside - 1.0) * wavenumber(gigahertz);
  ScatteringMatrix sum, shifted;
  scattering_pieces(
      target, c.sweep, 0, gigahertz, options_of(c), 0.2 * lambda,
      [&](ScatteringPiece piece) {
        sum += piece.s;
        shifted += piece.s *= std::polar(beside, 2.0 * dk * glm::dot(piece.place, spherical_basis(off).radial));
      },
      c.ground);
  Case other = c;
  other.sweep.frequencies = {beside * gigahertz};
  const ScatteringMatrix here = solve_case(plate.soup(), c).total[0], there = solve_case(plate.soup(), other).total[0];
  EXPECT_LT(largest_difference(sum, here), 1e-12 * largest_amplitude(here));
  EXPECT_LT(largest_difference(shifted, there), 0.02 * largest_amplitude(there));
  EXPECT_GT(largest_difference(here, there), 0.2 * largest_amplitude(there));  // else it says nothing
}

TEST(GroundTrace, OverAMediumTheGroundLightsATargetToo) {
  const Look look{aside, off, 3.0, 2.0};
  EXPECT_EQ(lighting_looks(look, {}).size(), 1u);
  EXPECT_EQ(lighting_looks(look, Ground{0.1, {}}).size(), 1u);
  const std::vector<Look> lighting = lighting_looks(look, medium(0.1));
  ASSERT_EQ(lighting.size(), 2u);
  EXPECT_EQ(lighting[0].transmit, aside);
  const dvec3 straight = lighting[0].transmitter().point(), image = lighting[1].transmitter().point();
  EXPECT_NEAR(image.z, 0.2 - straight.z, 1e-12);
  EXPECT_NEAR(image.x, straight.x, 1e-12);
}

}  // namespace
}  // namespace raytube
