// Cases in which bodies move: against the same mesh exported where its bodies are then, and against phases in closed form.
#include <gmock/gmock.h>

#include <cstring>
#include <map>
#include <mutex>

#include "plan/phase_reference.h"
#include "solved_case.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string looks_up = "[look]\ntheta_deg = [90.0, 63.0]\nphi_deg = [0.0, 20.0]\n";

std::string case_text(const std::string& more, const std::string& looks = looks_up) {
  return "[target]\nmesh = \"m.obj\"\nunit = \"m\"\n[frequency]\nghz = [9.7, 10.0]\n" + looks + more;
}

// A square of ten centimetres that faces +x, and a smaller one at an angle behind it: without any symmetry, and no edge of one in
// the plane of the other.
std::string plates(const std::string& name, const std::function<dvec3(const dvec3&)>& pose, std::size_t& vertices) {
  const std::vector<dvec3> corners = {{0, -.05, -.05},    {0, .05, -.05},     {0, .05, .05},     {0, -.05, .05},
                                      {-.004, .06, -.02}, {-.035, .1, -.025}, {-.033, .1, .037}, {-.002, .06, .042}};
  std::string text = "g " + name + "\n";
  for (const dvec3& corner : corners) {
    const dvec3 at = pose(corner);
    text += fmt::format("v {} {} {}\n", at.x, at.y, at.z);
  }
  for (std::size_t i = 0; i < 2; ++i, vertices += 4)
    text += fmt::format("f {} {} {} {}\n", vertices + 1, vertices + 2, vertices + 3, vertices + 4);
  return text;
}

std::string one_body(const Pose& pose = {}) {
  std::size_t vertices = 0;
  return plates("a", pose, vertices);
}

double difference(const ScatteringMatrix& a, const ScatteringMatrix& b) { return frobenius_norm(a - b) / frobenius_norm(b); }

bool same_bits(const std::vector<ScatteringMatrix>& a, const std::vector<ScatteringMatrix>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

constexpr double rounding = 1e-9;  // of rows of turned and shifted polygons, whose edges are cut elsewhere (stress/motion_test)

TEST(Moving, ASceneAtRestHasTheBitsOfTheCaseWithoutMotion) {
  const Solved still = solved(one_body(), case_text("")),
               rest = solved(
                   one_body(),
                   case_text("[motion]\ntimes_s = [0.0, 0.1, 0.4]\n[motion.bodies.all]\naxis = [1, 0, 0]\ndeg_per_s = 0\n"));
  const std::size_t rows = still.result.total.size();
  ASSERT_EQ(rest.result.total.size(), 3 * rows);
  for (std::size_t pulse = 0; pulse < 3; ++pulse) {
    const auto first = rest.result.total.begin() + static_cast<std::ptrdiff_t>(pulse * rows);
    EXPECT_TRUE(same_bits({first, first + static_cast<std::ptrdiff_t>(rows)}, still.result.total)) << pulse;
  }
  EXPECT_EQ(rest.result.statistics.tubes, still.result.statistics.tubes);  // traced once
}

TEST(Moving, VelocityTurnsThePhaseAndNothingElse) {
  const Solved still = solved(one_body(), case_text("")),
               moving = solved(one_body(), case_text("[motion]\npulses = { interval_s = 1e-4, count = 9 }\n"
                                                     "[motion.bodies.all]\nvelocity_m_per_s = [7.0, -3.0, 2.0]\n"));
  const std::size_t rows = still.result.total.size();
  for (std::size_t row = 0; row < moving.result.total.size(); ++row) {
    const std::size_t look = row / still.c.sweep.frequencies.size();
    const Complex phase = shifted_phase(moving.c.sweep.times[look] * dvec3(7, -3, 2), moving.c.sweep.looks[look],
                                        still.c.sweep.frequencies[row % still.c.sweep.frequencies.size()]);
    ScatteringMatrix expected = still.result.total[row % rows];
    EXPECT_LT(difference(moving.result.total[row], expected *= phase), 1e-14) << row;
    EXPECT_EQ(moving.result.error[row], still.result.error[row % rows]) << row;
  }
  EXPECT_THAT(moving.warnings, IsEmpty());
}

const std::string tilted =
    "[motion]\ntimes_s = [0.0, 0.25]\n[motion.bodies.all]\naxis = [1, 2, 3]\nthrough_m = [0.2, -0.1, 0.3]\n"
    "deg_per_s = 80.0\nangle_deg = 5.0\nvelocity_m_per_s = [0.3, 0.1, -0.2]\n";

// As one body it is seen from elsewhere; exported where it is then it is another mesh.
TEST(Moving, ATurnedBodyIsTheMeshTurnedByHand) {
  const Solved moving = solved(one_body(), case_text(tilted));
  const Solved by_hand = solved(one_body(pose_of(moving.c.motion->motion, 0, 0.25)), case_text(""));
  const std::size_t rows = by_hand.result.total.size();
  ASSERT_GT(frobenius_norm(by_hand.result.total[0]), 0.0);
  for (std::size_t row = 0; row < rows; ++row)
    EXPECT_LT(difference(moving.result.total[rows + row], by_hand.result.total[row]), rounding) << row;
}

TEST(Moving, ATransmitterAndAReceiverOfItsOwnToo) {
  const std::string bistatic = looks_up + "[receive]\ntheta_deg = 80.0\nphi_deg = 40.0\n";
  const Solved moving = solved(one_body(), case_text(tilted, bistatic));
  const Solved by_hand = solved(one_body(pose_of(moving.c.motion->motion, 0, 0.25)), case_text("", bistatic));
  const std::size_t rows = by_hand.result.total.size();
  for (std::size_t row = 0; row < rows; ++row)
    EXPECT_LT(difference(moving.result.total[rows + row], by_hand.result.total[row]), rounding) << row;
}

std::string three_bodies(const std::function<Pose(std::size_t)>& pose) {
  std::string text;
  std::size_t vertices = 0;
  const std::array<dvec3, 3> places = {dvec3(0.0), dvec3(-0.1, 0.45, 0.0), dvec3(-0.2, -0.45, 0.1)};
  for (std::size_t i = 0; i < 3; ++i)
    text += plates(
        std::string(1, static_cast<char>('a' + i)), [&](const dvec3& r) { return pose(i)(r + places[i]); }, vertices);
  return text;
}

const std::string three_motions =
    "[motion]\npulses = { start_s = -0.01, interval_s = 1e-2, count = 4 }\n"
    "[motion.bodies.car]\nparts = \"a\"\nvelocity_m_per_s = [1.5, 0.0, 0.2]\n"
    "[motion.bodies.wheel]\nparts = [\"b\"]\non = \"car\"\naxis = [0, 1, 0]\nthrough_m = [-0.1, 0.45, 0.0]\nrev_per_min = 60\n";

// Bodies of their own: every time is a scene of its own, from which their interaction and shadows follow.
TEST(Moving, ThreeBodiesAreTheMeshExportedAtThatTime) {
  const auto at_rest = [](std::size_t) { return Pose(); };
  const Solved moving = solved(three_bodies(at_rest), case_text(three_motions));
  const Motion& motion = moving.c.motion->motion;
  const Solved by_hand =
      solved(three_bodies([&](std::size_t body) { return body < 2 ? pose_of(motion, body, 0.02) : Pose(); }), case_text(""));
  const std::size_t rows = by_hand.result.total.size();
  ASSERT_EQ(moving.result.total.size(), 4 * rows);
  for (std::size_t row = 0; row < rows; ++row) {
    EXPECT_LT(difference(moving.result.total[3 * rows + row], by_hand.result.total[row]), rounding) << row;
    ScatteringMatrix sum;
    for (const auto& column : moving.result.bounces) sum += column[3 * rows + row];
    for (const MechanismRows& mechanism : moving.result.mechanisms) sum += mechanism.rows[3 * rows + row];
    EXPECT_LT(difference(sum, moving.result.total[3 * rows + row]), 1e-12) << row;
  }
}

TEST(Moving, ThreadsAndKeptTimesChangeNoBit) {
  const std::string mesh = three_bodies([](std::size_t) { return Pose(); });
  std::map<std::size_t, std::string> kept;
  std::mutex mutex;
  const KeptLooks keep{{}, {}, [&](std::size_t index, std::string bytes) {
                         const std::lock_guard lock(mutex);
                         kept[index] = std::move(bytes);
                       }};
  const Solved first = solved(mesh, case_text(three_motions), 1, keep);
  EXPECT_EQ(kept.size(), 4u);
  kept.erase(2);
  std::size_t computed = 0;
  const KeptLooks resume{{},
                         [&](std::size_t index) { return kept.contains(index) ? kept.at(index) : std::string(); },
                         [&](std::size_t, const std::string&) { ++computed; }};
  const Solved second = solved(mesh, case_text(three_motions), 3, resume);
  EXPECT_EQ(computed, 1u);
  EXPECT_TRUE(same_bits(first.result.total, second.result.total));
}

double difference_of_all(const std::vector<ScatteringMatrix>& a, const std::vector<ScatteringMatrix>& b) {
  double squares = 0.0, all = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i)
    squares += std::norm(frobenius_norm(a[i] - b[i])), all += std::norm(frobenius_norm(b[i]));
  return std::sqrt(squares / all);
}

std::string retraced(std::string text) { return text.replace(text.find("[motion]\n"), 9, "[motion]\nretrace = \"auto\"\n"); }

// The largest share of S of a look and a frequency, over all times.
double largest_difference(const Solved& few, const Solved& every) {
  const std::size_t times = every.c.times(), rows = every.result.total.size() / times;
  double largest = 0.0;
  for (std::size_t row = 0; row < rows; ++row) {
    std::vector<ScatteringMatrix> found, expected;
    for (std::size_t time = 0; time < times; ++time)
      found.push_back(few.result.total[time * rows + row]), expected.push_back(every.result.total[time * rows + row]);
    largest = std::max(largest, difference_of_all(found, expected));
  }
  return largest;
}

std::uint64_t times_not_traced(const Solved& solved) {
  const std::vector<Skipped>& skipped = solved.result.statistics.skipped;
  const auto told = std::ranges::find(skipped, std::string(times_between), &Skipped::what);
  return told == skipped.end() ? 0 : told->count;
}

// Three bodies that only shift, each with its own velocity, and edges that do not light other bodies: each has its phase, but for
// the share of functions that is left out, 1e-4 of each.
TEST(Moving, WhatOnlyShiftsIsFoundFromAFewTimes) {
  const std::string mesh = three_bodies([](std::size_t) { return Pose(); }),
                    text = case_text(
                        "[edges]\nbetween = false\n[tubes]\nmax_bounces = 2\n"
                        "[motion]\npulses = { interval_s = 5e-4, count = 128 }\n"
                        "[motion.bodies.a]\nparts = \"a\"\nvelocity_m_per_s = [3.0, 0.0, 0.0]\n"
                        "[motion.bodies.b]\nparts = \"b\"\nvelocity_m_per_s = [-2.0, 1.0, 0.5]\n");
  const Solved every = solved(mesh, text), few = solved(mesh, retraced(text));
  ASSERT_EQ(few.result.total.size(), every.result.total.size());
  EXPECT_LT(difference_of_all(few.result.total, every.result.total), 1e-3);
  EXPECT_LT(3 * few.result.statistics.tubes, every.result.statistics.tubes);
}

// Over ground S also has paths by way of it, once and twice, whose rates are others.
TEST(Moving, OverGroundItIsFoundFromAFewTimesToo) {
  const std::string text = case_text(
      "[ground]\nheight_m = -1.0\n[motion]\npulses = { interval_s = 1e-3, count = 128 }\n"
      "[motion.bodies.a]\nvelocity_m_per_s = [0.0, 0.3, 1.5]\n",
      "[look]\ntheta_deg = 50\nphi_deg = 20\n");
  const Solved every = solved(one_body(), text), few = solved(one_body(), retraced(text));
  EXPECT_LT(difference_of_all(few.result.total, every.result.total), 1e-3);
  EXPECT_LT(2 * few.result.statistics.tubes, every.result.statistics.tubes);
}

// A plate throws the wave from +x on another in +y, which moves, and that to a receiver. Borders of light wander over it at
// speeds of their own, which are not in the sample and are told; a path that counted both antennas at both plates was off by all
// of S.
TEST(Moving, BetweenBodiesTheWayBeginsAndEndsWhereTheAntennasAre) {
  const auto plate = [](const char* name, const dvec3& middle, double azimuth, double half, int before) {
    std::string lines = fmt::format("g {}\n", name);
    for (const auto& [along, up] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
      lines += fmt::format("v {} {} {}\n", middle.x - half * along * std::sin(azimuth),
                           middle.y + half * along * std::cos(azimuth), middle.z + half * up);
    return lines + fmt::format("f {} {} {} {}\n", before + 1, before + 2, before + 3, before + 4);
  };
  const std::string mesh = plate("a", dvec3(0.0), 45.0 * degree, 0.1, 0) + plate("b", {0.0, 1.0, 0.0}, -60.0 * degree, 0.2, 4),
                    text = case_text(
                        "[edges]\nmethod = \"none\"\n[motion]\npulses = { interval_s = 1e-3, count = 256 }\n"
                        "[motion.bodies.b]\nparts = \"b\"\nvelocity_m_per_s = [0.2, 0.7, 0.0]\n",
                        "[look]\ntheta_deg = 90\nphi_deg = 0\n[receive]\ntheta_deg = 90\nphi_deg = -30\n");
  const Solved every = solved(mesh, text), few = solved(mesh, retraced(text));
  const double off = difference_of_all(few.result.total, every.result.total);
  measured("what a moving plate gets from another, S between traced times against every time traced", off, "");
  EXPECT_LT(off, 0.05);
  EXPECT_LT(2 * few.result.statistics.tubes, every.result.statistics.tubes);
}

// Polarisation turns with a body that turns about the line of sight, and no path changes.
TEST(Moving, WhatTurnsAboutTheLineOfSightIsFoundFromAFewTimes) {
  const std::string text =
      case_text("[motion]\npulses = { interval_s = 1e-3, count = 128 }\n[motion.bodies.a]\naxis = [1, 0, 0]\nrev_per_min = 300\n",
                "[look]\ntheta_deg = 90\nphi_deg = 0\n");
  const Solved every = solved(one_body(), text), few = solved(one_body(), retraced(text));
  EXPECT_LT(difference_of_all(few.result.total, every.result.total), 1e-3);
  EXPECT_GT(times_not_traced(few), 64u);
}

// The receiver at 80 degrees, one among many where hardly anything changes, asks for more times than they do. Facets that turn
// from the light are off by some hundredths.
TEST(Moving, EveryReceiverIsFoundFromAFewTimes) {
  const std::string text = case_text(
      "[edges]\nmethod = \"none\"\n[motion]\npulses = { interval_s = 5e-4, count = 128 }\n"
      "[motion.bodies.a]\naxis = [0, 1, 0]\nthrough_m = [-0.2, 0.0, 0.0]\nrev_per_min = 30\n",
      "[look]\ntheta_deg = 90\nphi_deg = 0\n"
      "[receive]\ntheta_deg = 90\nphi_deg = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 80.0]\n");
  const Solved every = solved(one_body(), text), few = solved(one_body(), retraced(text));
  EXPECT_LT(largest_difference(few, every), 0.03);
  EXPECT_GT(times_not_traced(few), 32u);
}

// Facets that turn come to light and go out of it: that is in no bound, but it is told, to a factor of three of what the checked
// times show by chance.
TEST(Moving, WhatIsFoundBetweenTracedTimesTellsItsError) {
  const std::string text = case_text(
      "[motion]\npulses = { interval_s = 1e-3, count = 400 }\n[motion.bodies.all]\n"
      "axis = [0, 0, 1]\nrev_per_min = 60\n");
  const Solved every = solved(one_body(), text), few = solved(one_body(), retraced(text));
  const double off = largest_difference(few, every);
  measured("turning plates, S between traced times against every time traced", off, "");
  EXPECT_LT(off, 0.1);
  const auto told = std::ranges::find(few.result.statistics.skipped, "times", &Skipped::what);
  ASSERT_NE(told, few.result.statistics.skipped.end());
  const double said = told->figure;
  EXPECT_LT(off, 3.0 * said);
  EXPECT_GT(off, said / 3.0);
  EXPECT_GT(told->count, 200u);
  EXPECT_THAT(few.warnings, ::testing::Contains(HasSubstr("write motion.retrace = \"every\"")));
}

// Points that no polygon has are in many files.
TEST(Moving, PointsBesideThePolygonsStandInNoAntennasWay) {
  const std::string text = case_text(
      "[radar]\nposition_m = [5.0, 0.0, 1.0]\n[motion]\npulses = { interval_s = 1e-3, count = 2 }\n"
      "[motion.bodies.a]\nvelocity_m_per_s = [1.0, 0.0, 0.0]\n",
      "");
  EXPECT_TRUE(same_bits(solved(one_body() + "v 20 0 0\n", text).result.total, solved(one_body(), text).result.total));
}

// An antenna that has moved on is the one that stands there, with an aim that stands or one that has moved as far.
TEST(Moving, AntennasThatMoveAreThoseThatStandThere) {
  const auto radar = [](const std::string& place, const std::string& aim, const std::string& more) {
    return case_text("[radar]\nbeamwidth_deg = 5.0\nposition_m = " + place + "\naim_m = " + aim + "\n" + more, "");
  };
  const std::string at = "[motion]\ntimes_s = 0.5\n[motion.radar]\nvelocity_m_per_s = [0.0, 1.0, -0.5]\n",
                    start = "[4.0, 1.0, 1.0]", there = "[4.0, 1.5, 0.75]";
  const auto rows = [&](const std::string& text) { return solved(one_body(), text).result.total; };
  const auto standing = rows(radar(there, "[0.0, 0.1, 0.0]", "")), strip = rows(radar(there, "[0.0, 0.6, -0.25]", ""));
  EXPECT_TRUE(same_bits(rows(radar(start, "[0.0, 0.1, 0.0]", at)), standing));
  EXPECT_TRUE(same_bits(rows(radar(start, "[0.0, 0.1, 0.0]", at + "aim_moves = true\n")), strip));
  EXPECT_FALSE(same_bits(standing, strip));
}

TEST(Moving, BodiesThatRunIntoOneAnotherAreTold) {
  const std::string mesh = three_bodies([](std::size_t) { return Pose(); });
  const std::string towards =
      "[motion]\ntimes_s = { start = 0.0, stop = 0.5, count = 51 }\n[motion.bodies.b]\nparts = \"b\"\n"
      "velocity_m_per_s = [0.2, -0.9, 0.0]\n";
  EXPECT_THAT(solved(mesh, case_text(towards, "[look]\ntheta_deg = 90\nphi_deg = 0\n")).warnings,
              ::testing::Contains(HasSubstr("motion.bodies.b and what stands run into one another from 0.")));
}

// At v along the look the path changes by 2 v T: more than half a wave from T = lambda / (4 v) on.
TEST(Moving, AmbiguousPulsesAreToldWithTheIntervalThatWouldDo) {
  const auto warnings = [](const char* interval) {
    return solved(one_body(), case_text(fmt::format("[motion]\npulses = {{ interval_s = {}, count = 3 }}\n[motion.bodies.all]\n"
                                                    "velocity_m_per_s = [10.0, 0.0, 0.0]\n",
                                                    interval),
                                        "[look]\ntheta_deg = 90\nphi_deg = 0\n"))
        .warnings;
  };
  const double would_do = wavelength(10e9) / 40.0;
  EXPECT_THAT(warnings("7.4e-4"), IsEmpty());
  EXPECT_THAT(warnings("7.6e-4"), ::testing::ElementsAre(HasSubstr(fmt::format("an interval of {:.3g} s would do", would_do))));
}

}  // namespace
}  // namespace raytube
