// Doppler of bodies that move through the whole program: velocities, ranges and levels against closed forms, and against each
// body alone at rest.
#include "imaging/doppler.h"

#include <gmock/gmock.h>

#include "imaging/isar.h"
#include "shapes.h"
#include "solved_case.h"

namespace raytube {
namespace {

using namespace raytube::testing;

struct NamedBody {
  std::string name;
  PolygonSoup soup;
};

std::string obj_text(const std::vector<NamedBody>& bodies) {
  std::string text;
  std::size_t before = 1;
  for (const auto& [name, soup] : bodies) {
    text += "g " + name + "\n";
    for (const dvec3& p : soup.points) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    for (const auto& polygon : soup.polygons) {
      text += "f";
      for (const std::uint32_t corner : polygon) text += fmt::format(" {}", corner + before);
      text += "\n";
    }
    before += soup.points.size();
  }
  return text;
}

std::string case_text(const std::string& ghz, const std::string& more) {
  return "[target]\nmesh = \"m.obj\"\nunit = \"m\"\n[frequency]\nghz = " + ghz + "\n" + more;
}

SweepSamples samples_of(const Solved& solved) {
  const Sweep& sweep = solved.c.sweep;
  const std::vector<double>& f = sweep.frequencies;
  SweepSamples samples{.frequency = {f.front(), f.size() > 1 ? f[1] - f[0] : 0.0, f.size()}};
  for (const Look& look : sweep.looks)
    samples.looks.push_back(
        {spherical_basis(look.transmit).radial, spherical_basis(look.receive).radial, look.transmit_range, look.receive_range});
  samples.s = solved.result.total, samples.error = solved.result.error, samples.model = solved.result.model;
  samples.times = sweep.times;
  return samples;
}

double db(double ratio) { return 20.0 * std::log10(ratio); }

struct Place {
  double range, velocity, amplitude;  // [m], [m/s], [m] of VV
};

// The highest place of a map of one look within a cell of another, between its samples: by parabolas through levels, which at
// eight samples to a cell are a hundredth of a cell and of a decibel off at most.
constexpr int fine = 8;
Place highest_near(const DopplerMap& map, double range, double velocity) {
  const auto level = [&](std::size_t r, std::size_t v) { return std::log(std::abs(map.s[r * map.velocity.count + v].s[0][0])); };
  const auto nearest = [](const EvenAxis& axis, double x) {
    return axis.count == 1 ? std::size_t{0} : static_cast<std::size_t>(std::lround((x - axis.first) / axis.step));
  };
  const std::size_t r0 = nearest(map.range, range), v0 = nearest(map.velocity, velocity), reach = map.range.count == 1 ? 0 : fine;
  std::size_t r = r0, v = v0;
  for (std::size_t i = r0 - reach; i <= r0 + reach; ++i)
    for (std::size_t j = v0 - fine; j <= v0 + fine; ++j)
      if (level(i, j) > level(r, v)) r = i, v = j;
  double top = level(r, v);
  const auto between = [&](double before, double after) {
    const double slope = 0.5 * (after - before), bend = before + after - 2.0 * level(r, v);
    top -= 0.5 * slope * slope / bend;
    return -slope / bend;
  };
  const double along_v = between(level(r, v - 1), level(r, v + 1));
  const double along_r = reach ? between(level(r - 1, v), level(r + 1, v)) : 0.0;
  return {map.range.at(r) + along_r * map.range.step, map.velocity.at(v) + along_v * map.velocity.step, std::exp(top)};
}

const std::string from_x = "[look]\ntheta_deg = 90.0\nphi_deg = 0.0\n", one_bounce = "[tubes]\nmax_bounces = 1\n",
                  no_waves = "[surfaces]\nwaves = false\n";
const dmat3 faces_x(dvec3(0, 0, -1), dvec3(0, 1, 0), dvec3(1, 0, 0));  // takes z to x

// 64 pulses 50 microseconds apart at 77 GHz: cells of .61 m/s.
void expect_velocity_and_level(const PolygonSoup& body, const std::string& look, const dvec3& towards) {
  const std::string mesh = obj_text({{"a", body}}), text = case_text("77.0", look);
  const Solved still = solved(mesh, text);
  const Solved moving = solved(mesh, text +
                                         "[motion]\npulses = { interval_s = 5e-5, count = 64 }\n[motion.bodies.a]\n"
                                         "velocity_m_per_s = [9.3, -4.1, 2.2]\n");
  const DopplerMap map = doppler_map(samples_of(moving), {}, "test");
  const double off = (map.peak.velocity - glm::dot(dvec3(9.3, -4.1, 2.2), towards)) / map.velocity_limits.cell;
  const double level = db(map.peak.amplitude / std::abs(still.result.total[0].s[0][0]));
  measured("velocity off by", off, "cells");
  measured("level beside that at rest", level, "dB");
  EXPECT_NEAR(off, 0.0, 0.05);
  EXPECT_NEAR(level, 0.0, 0.1);
}

TEST(DopplerOfBodies, APlateAtItsVelocity) {
  expect_velocity_and_level(shapes::transformed(shapes::plate(0.1), faces_x), from_x, dvec3(1, 0, 0));
}

TEST(DopplerOfBodies, ATrihedralAtItsVelocity) {
  const double theta = std::acos(1.0 / std::sqrt(3.0));
  expect_velocity_and_level(shapes::trihedral(0.1), fmt::format("[look]\ntheta_deg = {}\nphi_deg = 45.0\n", theta / degree),
                            dvec3(1.0 / std::sqrt(3.0)));
}

// A ball on an arm, with 300 revolutions a minute: 31.4 m/s times the sine of the angle to the axis, and the cosine of the turn.
// A window is even about its middle, so that what the velocity gains in one half it loses in the other.
TEST(DopplerOfBodies, TipsOfARotorByTheSineAndCosineOfTheAngles) {
  const PolygonSoup ball = shapes::icosphere(2, 0.05);
  const auto at = [&](double x) { return shapes::transformed(ball, dmat3(1.0), 1.0, dvec3(x, 0, 0)); };
  const Solved rotor =
      solved(obj_text({{"a", at(1.0)}}), case_text("10.0",
                                                   "[look]\ntheta_deg = 60.0\nphi_deg = 0.0\n[motion]\n"
                                                   "pulses = { interval_s = 2e-4, count = 801 }\n[motion.bodies.rotor]\n"
                                                   "axis = [0, 0, 1]\nrev_per_min = 300\n"));
  SpectrogramOptions options;
  options.length = 17, options.overlap = 0.0, options.padding = 16;
  const Spectrogram found = spectrogram(samples_of(rotor), options, "test");
  double worst = 0.0;
  for (std::size_t i = 0; i < found.time.count; ++i) {
    const auto row = found.sigma.begin() + static_cast<std::ptrdiff_t>(i * found.velocity.count);
    const auto top = std::max_element(row, row + static_cast<std::ptrdiff_t>(found.velocity.count),
                                      [](const auto& a, const auto& b) { return a[0][0] < b[0][0]; });
    const double turn = 10.0 * pi * found.time.at(i);
    const double expected = -10.0 * pi * std::sin(60.0 * degree) * std::sin(turn);
    worst = std::max(worst, std::abs(found.velocity.at(static_cast<std::size_t>(top - row)) - expected));
  }
  measured("tips of a rotor off by", worst / found.velocity_limits.cell, "cells");
  EXPECT_LT(worst / found.velocity_limits.cell, 0.05);
}

// A wheel that rolls: a ball on the rim moves with v (1 + cos), 0 where it meets the road and 2 v above, and the axle with v.
TEST(DopplerOfBodies, ARollingWheelFromNoughtToTwiceItsVelocity) {
  const auto ball = [](const dvec3& middle) { return shapes::transformed(shapes::icosphere(2, 0.03), dmat3(1.0), 1.0, middle); };
  const std::vector<NamedBody> bodies = {
      {"axle", ball({0, 0, 0.3})}, {"high", ball({0, 0.2, 0.6})}, {"low", ball({0, -0.2, 0.0})}};
  // v = 2 pi * 0.3 m * 160 / 60 s; from 64 pulses of which the middle one is at time 0
  const double v = 2.0 * pi * 0.3 * 160.0 / 60.0;
  const Solved wheel = solved(
      obj_text(bodies),
      case_text("24.0",
                from_x + one_bounce +
                    fmt::format("[motion]\npulses = {{ start_s = -6.3e-3, interval_s = 2e-4, count = 64 }}\n"
                                "[motion.bodies.car]\nvelocity_m_per_s = [{}, 0, 0]\n[motion.bodies.wheel]\non = \"car\"\n"
                                "parts = [\"high\", \"low\"]\naxis = [0, 1, 0]\nthrough_m = [0, 0, 0.3]\nrev_per_min = 160\n",
                                v)));
  const Solved alone = solved(obj_text({bodies[0]}), case_text("24.0", from_x + one_bounce));
  DopplerOptions options;
  options.padding = fine, options.window = {WindowKind::kaiser, 70.0};
  const DopplerMap map = doppler_map(samples_of(wheel), options, "test");
  for (const double expected : {0.0, v, 2.0 * v}) {
    const Place found = highest_near(map, 0.0, expected);
    const double off = (found.velocity - expected) / map.velocity_limits.cell;
    const double level = db(found.amplitude / std::abs(alone.result.total[0].s[0][0]));
    measured("rolling wheel, velocity off by", off, "cells");
    measured("rolling wheel, level beside a ball alone", level, "dB");
    EXPECT_NEAR(off, 0.0, 0.05) << expected;
    EXPECT_NEAR(level, 0.0, 0.1) << expected;
  }
}

const PolygonSoup small_ball = shapes::icosphere(2, 0.03);
const std::string band = "{ start = 23.5, stop = 24.5, count = 33 }";  // a cell of .15 m, 4.8 m without ambiguity

std::vector<NamedBody> balls_at(const std::vector<dvec3>& places) {
  std::vector<NamedBody> bodies;
  for (const dvec3& place : places)
    bodies.push_back(
        {std::string(1, static_cast<char>('a' + bodies.size())), shapes::transformed(small_ball, dmat3(1.0), 1.0, place)});
  return bodies;
}

// Each at its own range and velocity. The fastest one crosses a cell of range while the pulses are sent.
TEST(DopplerOfBodies, ThreeBallsAtThreeVelocitiesAreInPlaceAndAsStrongAsAlone) {
  const std::vector<NamedBody> bodies = balls_at({{-0.7, 0.4, 0.0}, {0.1, 0.0, 0.0}, {0.9, -0.4, 0.0}});
  const std::array<double, 3> velocities = {-9.3, 3.4, 12.1};
  std::string motion = "[motion]\npulses = { start_s = -6.3e-3, interval_s = 2e-4, count = 64 }\n";
  for (std::size_t i = 0; i < 3; ++i)
    motion +=
        fmt::format("[motion.bodies.{0}]\nparts = \"{0}\"\nvelocity_m_per_s = [{1}, 0, 0]\n", bodies[i].name, velocities[i]);
  DopplerOptions options;
  options.padding = fine, options.window = {WindowKind::kaiser, 70.0};
  const DopplerMap map =
      doppler_map(samples_of(solved(obj_text(bodies), case_text(band, from_x + no_waves + motion))), options, "test");
  for (std::size_t i = 0; i < 3; ++i) {
    const RangePeak alone =
        range_profiles(samples_of(solved(obj_text({bodies[i]}), case_text(band, from_x + no_waves))), {options.window}).peak;
    const Place found = highest_near(map, alone.range, velocities[i]);
    const double range = (found.range - alone.range) / map.range_limits->cell,
                 velocity = (found.velocity - velocities[i]) / map.velocity_limits.cell,
                 level = db(found.amplitude / alone.amplitude);
    measured("three balls, range off by", range, "cells");
    measured("three balls, velocity off by", velocity, "cells");
    measured("three balls, level beside each alone", level, "dB");
    EXPECT_NEAR(range, 0.0, 0.1) << i;
    EXPECT_NEAR(velocity, 0.0, 0.1) << i;
    EXPECT_NEAR(level, 0.0, 0.1) << i;
  }
}

// Antennas that fly past a scene at 10 m, by 1 m: .06 m across.
TEST(DopplerOfBodies, ASpotlightImageFromATrackHasThreeBallsInPlace) {
  const std::vector<dvec3> places = {{-0.5, 0.4, 0.0}, {0.0, -0.45, 0.0}, {0.55, 0.05, 0.0}};
  const std::vector<NamedBody> bodies = balls_at(places);
  const std::string spot_band = "{ start = 23.5, stop = 24.5, count = 9 }",
                    radar = "[radar]\nposition_m = [[10.0, 0.0, 0.0]]\n" + no_waves,
                    track =
                        "[motion]\npulses = { start_s = -0.05, interval_s = 6.25e-3, count = 17 }\n"
                        "[motion.radar]\nvelocity_m_per_s = [0, 10, 0]\n";
  const SweepSamples samples = samples_of(solved(obj_text(bodies), case_text(spot_band, radar + track)));
  std::vector<dvec3> antennas;
  for (const SweepLook& look : samples.looks) antennas.push_back(look.transmit_range * look.transmit);
  const std::optional<AngleGrid> grid = scan_grid(antennas);
  ASSERT_TRUE(grid);
  for (std::size_t i = 0; i < 3; ++i) {
    IsarOptions options;
    options.frame = {.size = {0.4, 0.2, 0.0}, .middle = places[i]};
    const IsarImage image = isar_image(samples, *grid, options, "test");
    const RangePeak alone = range_profiles(samples_of(solved(obj_text({bodies[i]}), case_text(spot_band, radar))), {}).peak;
    const dvec3 off = image.peak.place - (places[i] + 0.03 * glm::normalize(dvec3(10, 0, 0) - places[i]));
    const double level = db(image.peak.amplitude / alone.amplitude);
    measured("spotlight, range off by", off.x / image.axes[0].cell, "cells");
    measured("spotlight, cross-range off by", off.y / image.axes[1].cell, "cells");
    measured("spotlight, level beside each alone", level, "dB");
    EXPECT_NEAR(off.x / image.axes[0].cell, 0.0, 0.1) << i;
    EXPECT_NEAR(off.y / image.axes[1].cell, 0.0, 0.1) << i;
    EXPECT_NEAR(level, 0.0, 0.2) << i;
  }
}

}  // namespace
}  // namespace raytube
