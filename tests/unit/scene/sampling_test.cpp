// How far apart rows may lie, just within and just beyond.
#include "scene/sampling.h"

#include <gmock/gmock.h>

#include "output/tables/sampled_rows.h"
#include "shapes.h"

namespace raytube {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double frequency = 10e9;
const double lambda = wavelength(frequency);
const std::vector<dvec3> rod_y{{0.0, -0.5, 0.0}, {0.0, 0.5, 0.0}};  // 1 m
const std::vector<dvec3> rod_x{{-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}};

Look monostatic(double theta, double phi) { return {{theta, phi}, {theta, phi}}; }

double turn(const std::vector<dvec3>& points, const Look& a, const Look& b) {
  return phase_turn(points, scattering_vector(a, frequency), scattering_vector(b, frequency));
}

TEST(Sampling, AQuarterWavelengthOverTheExtentAcross) {
  const double limit = lambda / 4.0;  // rad, of 1 m
  // A step of 7.5e-3 rad is its chord but for one part in 4e5.
  EXPECT_TRUE(resolved(turn(rod_y, monostatic(0.5 * pi, -0.5 * limit), monostatic(0.5 * pi, 0.5 * limit))));
  EXPECT_FALSE(resolved(turn(rod_y, monostatic(0.5 * pi, -0.5 * limit), monostatic(0.5 * pi, 0.501 * limit))));
  // Along the line of sight it has no extent across it.
  EXPECT_TRUE(resolved(turn(rod_x, monostatic(0.5 * pi, -0.5 * limit), monostatic(0.5 * pi, 0.501 * limit))));
}

TEST(Sampling, ReceiversAloneMayGoTwiceAsFar) {
  const Look at{{0.5 * pi, 0.0}, {0.5 * pi, -0.5 * lambda / 2.0}};
  EXPECT_TRUE(resolved(turn(rod_y, at, {{0.5 * pi, 0.0}, {0.5 * pi, 0.5 * lambda / 2.0}})));
  EXPECT_FALSE(resolved(turn(rod_y, at, {{0.5 * pi, 0.0}, {0.5 * pi, 0.501 * lambda / 2.0}})));
}

// Near the pole phi turns the direction by sin(theta) only.
TEST(Sampling, PhiCountsBySinTheta) {
  const double limit = lambda / 4.0 / std::sin(30.0 * degree);
  EXPECT_TRUE(resolved(turn(rod_y, monostatic(30.0 * degree, -0.5 * limit), monostatic(30.0 * degree, 0.5 * limit))));
  EXPECT_FALSE(resolved(turn(rod_y, monostatic(30.0 * degree, -0.5 * limit), monostatic(30.0 * degree, 0.501 * limit))));
}

TEST(Sampling, FrequencyCountsByTheExtentAlong) {
  const Look look = monostatic(0.5 * pi, 0.0);
  const double limit = speed_of_light / 4.0;  // Hz, of 1 m
  const auto to = [&](double step) { return scattering_vector(look, frequency + step); };
  EXPECT_TRUE(resolved(phase_turn(rod_x, scattering_vector(look, frequency), to(limit))));
  EXPECT_FALSE(resolved(phase_turn(rod_x, scattering_vector(look, frequency), to(1.001 * limit))));
  EXPECT_TRUE(resolved(phase_turn(rod_y, scattering_vector(look, frequency), to(100.0 * limit))));
}

TEST(Sampling, FewPointsAreAsWideAsAll) {
  const PolygonSoup ball = shapes::icosphere(5);
  const std::vector<dvec3> outermost = outermost_points(ball.points);
  EXPECT_LE(outermost.size(), 80u);
  EXPECT_NEAR(largest_extent(outermost), 2.0, 1e-3);  // opposite vertices are among them
  for (int i = 0; i < 50; ++i) {
    const dvec3 along = spherical_basis({std::acos(1.0 - 0.02 * i), 2.4 * i}).radial;
    const double width = phase_turn(outermost, dvec3(0.0), along);
    EXPECT_LE(width, 2.0 + 1e-12);
    EXPECT_GE(width, 2.0 * 0.95);  // as promised
  }
}

Sweep sweep_of_phi(std::size_t count, double step_deg, std::vector<double> frequencies = {frequency}) {
  Sweep sweep{std::move(frequencies), {}};
  for (std::size_t i = 0; i < count; ++i)
    sweep.looks.push_back(monostatic(0.5 * pi, (80.0 + step_deg * static_cast<double>(i)) * degree));
  return sweep;
}

TEST(CoarseSteps, AreToldWithWhatWouldDo) {
  const double limit = lambda / 4.0 / degree;  // 0.43 deg; of rod_x, seen across
  EXPECT_THAT(coarse_steps(sweep_of_phi(41, 0.4), rod_x), IsEmpty());
  const std::vector<CoarseSteps> found = coarse_steps(sweep_of_phi(5, 5.0), rod_x);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].quantity, RowCoordinates::phi);
  EXPECT_NEAR(found[0].step, 5.0, 1e-9);
  // Of a chord 5 degrees wide, seen up to 7.5 degrees off the perpendicular.
  EXPECT_NEAR(found[0].limit, limit, 0.01 * limit);
}

TEST(CoarseSteps, ListsAreNoSweeps) {
  Sweep few = sweep_of_phi(3, 5.0);
  EXPECT_THAT(coarse_steps(few, rod_x), IsEmpty());
  few.looks.push_back(monostatic(0.5 * pi, 0.3));
  few.looks.push_back(monostatic(0.5 * pi, 1.7));
  EXPECT_THAT(coarse_steps(few, rod_x), IsEmpty());  // uneven
  Sweep scattered{{frequency}, {}};
  for (int i = 0; i < 9; ++i) scattered.looks.push_back(monostatic(0.1 * i, 0.2 * i));
  EXPECT_THAT(coarse_steps(scattered, rod_x), IsEmpty());
}

TEST(CoarseSteps, EachSweptQuantityByItself) {
  std::vector<double> frequencies;
  for (int i = 0; i < 5; ++i) frequencies.push_back(frequency + 1e9 * i);
  const std::vector<dvec3> cross{{-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}, {0.0, -0.5, 0.0}, {0.0, 0.5, 0.0}};
  const std::vector<CoarseSteps> found = coarse_steps(sweep_of_phi(5, 5.0, frequencies), cross);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[1].quantity, RowCoordinates::frequency);
  EXPECT_NEAR(found[1].step, 1.0, 1e-9);
  EXPECT_NEAR(found[1].limit, 0.1499, 0.001);  // c / 2 m, in GHz; seen 10 degrees off at most
}

// Steps whose unambiguous range holds the target are fine for its range profile, though too wide for a line through levels.
TEST(CoarseSteps, InFrequencyAreJudgedByTheUnambiguousRange) {
  const std::vector<dvec3> deep{{-8.0, 0.0, 0.0}, {3.5, 0.0, 0.0}};  // 11.5 m
  const auto sweep_by = [](double step) {
    Sweep sweep{{}, {monostatic(0.5 * pi, 0.0)}};
    for (int i = 0; i < 8; ++i) sweep.frequencies.push_back(frequency + step * i);
    return sweep;
  };
  const std::vector<std::size_t> rows{0, 1, 2, 3, 4, 5, 6, 7};
  EXPECT_THAT(coarse_steps(sweep_by(7.5e6), deep), IsEmpty());  // c / (2 7.5 MHz) = 20 m
  EXPECT_FALSE(can_be_joined(sweep_by(7.5e6), deep, rows));
  EXPECT_THAT(coarse_steps(sweep_by(0.999 * speed_of_light / 23.0), deep), IsEmpty());
  EXPECT_EQ(coarse_steps(sweep_by(1.001 * speed_of_light / 23.0), deep).size(), 1u);
}

TEST(CoarseSteps, JoinedByALineOnlyWhereLobesAreResolved) {
  const std::vector<std::size_t> rows{0, 1, 2, 3, 4};
  EXPECT_TRUE(can_be_joined(sweep_of_phi(5, 0.4), rod_x, rows));
  EXPECT_FALSE(can_be_joined(sweep_of_phi(5, 0.5), rod_x, rows));
  EXPECT_TRUE(can_be_joined(sweep_of_phi(5, 0.5), {}, rows));
}

}  // namespace
}  // namespace raytube
