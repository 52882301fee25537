// Radars at a finite distance: brute-force quadrature, closed forms, limits and invariances.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "core/error.h"
#include "mesh/load.h"
#include "run.h"
#include "shapes.h"
#include "solve/solve.h"
#include "validation/point_waves.h"

namespace raytube {

using namespace point_waves;

namespace {

const Direction oblique{20 * degree, 0.4};

struct Scene {
  explicit Scene(PolygonSoup soup, EdgeMethod method = EdgeMethod::none)
      : loaded(build_mesh(std::move(soup), 1.0)), options(testing::options(method)), target(loaded.mesh) {
    options.tubes = {};
  }

  SweepResult solve(double frequency, const Look& look, const Radar& radar = {}) const {
    return raytube::solve(target, {{frequency}, {look}, !(look.transmit == look.receive), radar}, options);
  }
  ScatteringMatrix total(double frequency, const Look& look, const Radar& radar = {}) const {
    return solve(frequency, look, radar).total[0];
  }

  LoadedMesh loaded;
  SolveOptions options;
  Target target;
};

// Near-field PO of a plate in z = 0 by the midpoint rule, received by reaction.
ScatteringMatrix plate_by_quadrature(double a, const Look& look, double k, int steps) {
  ScatteringMatrix sum;
  const dvec3 normal(0, 0, spherical_basis(look.transmit).radial.z > 0.0 ? 1.0 : -1.0);
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const dvec3 r((i + 0.5) / steps * a - a / 2, (j + 0.5) / steps * a - a / 2, 0.0);
      const PointWave in = wave_at(look.transmit, look.transmit_range, r), out = wave_at(look.receive, look.receive_range, r);
      const Complex phasor = std::polar(a * a / (double(steps) * steps), -k * (in.path + out.path));
      for (int q = 0; q < 2; ++q) {
        const dvec3 eta_j = 2.0 * glm::cross(normal, glm::cross(in.direction, in.field[q]));
        for (int p = 0; p < 2; ++p) sum.at(p, q) += Complex(0.0, -k / (4.0 * pi)) * glm::dot(out.field[p], eta_j) * phasor;
      }
    }
  return sum;
}

// 5 wavelengths wide, so that 400 steps are 80 a wavelength: the midpoint rule is off by (k h)^2 / 24 = 3e-4, less where phases
// turn. Asked of the solver: 0.02 dB within 30 dB of the peak, which for these looks is 0.64 m at long range.
TEST(FiniteRange, PlateIsBruteForcePhysicalOptics) {
  const Scene scene(shapes::plate(0.15));
  constexpr double frequency = 10e9;
  double largest = 0.0;
  for (const double range : {0.2, 0.5, 2.0, 50.0}) {
    const double peak = std::abs(plate_by_quadrature(0.15, near_look({0, 0}, range), wavenumber(frequency), 400).vv());
    for (double theta = 0.0; theta < 45.0; theta += 4.5) {
      const Look look = near_look({theta * degree, 0.3}, range);
      const ScatteringMatrix expected = plate_by_quadrature(0.15, look, wavenumber(frequency), 400),
                             s = scene.total(frequency, look);
      for (const int c : {0, 1})
        if (std::abs(expected.at(c, c)) > peak * std::pow(10.0, -30.0 / 20.0))
          largest = std::max(largest, level_difference(s.at(c, c), expected.at(c, c)));
    }
  }
  testing::measured("finite range, plate against quadrature, within 30 dB of the peak", largest, "dB");
  EXPECT_LT(largest, 0.02);
}

TEST(FiniteRange, TransmitterAndReceiverMayStandApart) {
  const Scene scene(shapes::plate(0.15));
  const Look look = near_look({25 * degree, 0.3}, {50 * degree, 2.0}, 0.4, 0.9);
  const ScatteringMatrix expected = plate_by_quadrature(0.15, look, wavenumber(10e9), 400), s = scene.total(10e9, look);
  EXPECT_LT(frobenius_norm(s - expected), 1e-3 * frobenius_norm(expected));
}

// Uniform tubes find the same currents by rays. Ten per wavelength leave a staircase of some per cent at the slanted edges.
TEST(FiniteRange, UniformTubesConvergeToTheSame) {
  Scene scene(shapes::dihedral(0.15, 0.15));
  const Look look = near_look({80 * degree, 30 * degree}, 0.6);
  const ScatteringMatrix exact = scene.total(10e9, look);
  scene.options.tubes.mode = TubeMode::uniform;
  std::vector<double> error;
  for (const double density : {10.0, 40.0}) {
    scene.options.tubes.per_wavelength = density;
    error.push_back(frobenius_norm(scene.total(10e9, look) - exact) / frobenius_norm(exact));
  }
  EXPECT_LT(error[1], 0.01);
  EXPECT_LT(error[1], 0.5 * error[0]);
}

// Geometrical optics of a sphere from its centre's distance R: pi a^2 (R / (R - a))^2, the image of the antenna in it. Physical
// optics differs by its shadow boundary, .04 dB at ka = 100. Its facets are taken as the sphere.
TEST(FiniteRange, SphereSpreadsFromItsImage) {
  const Scene scene(shapes::icosphere(4));
  for (const double ka : {100.0, 200.0})
    for (const double range : {10.0, 40.0, 1e3}) {
      const double frequency = ka * speed_of_light / (2 * pi);
      const ScatteringMatrix s = scene.total(frequency, near_look({1.1, 2.0}, range));
      const double expected = std::sqrt(pi) * range / (range - 1.0) / std::sqrt(4 * pi);
      EXPECT_LT(level_difference(s.vv(), expected), 0.05) << ka << ' ' << range;
      EXPECT_LT(level_difference(s.hh(), expected), 0.05) << ka << ' ' << range;
    }
}

// The phase left at the ends of a target of extent D is k D^2 / (4 R) each way at most: relative error pi / 2 10^-4 at 10^4 D^2 /
// lambda, .0014 dB, less on average. It falls as 1 / R. At phi = 0 waves run exactly along edges.
TEST(FiniteRange, TendsToTheFarField) {
  for (const EdgeMethod method : {EdgeMethod::none, EdgeMethod::fringe})
    for (const Direction& direction : {Direction{60 * degree, 17 * degree}, Direction{60 * degree, 0.0}}) {
      Scene scene(shapes::box({0.15, 0.10, 0.06}), method);
      constexpr double frequency = 10e9;
      const double diameter = 2 * scene.loaded.mesh.radius, unit = diameter * diameter / wavelength(frequency);
      const ScatteringMatrix limit = scene.total(frequency, {direction, direction});
      double before = std::numeric_limits<double>::infinity();
      for (const double times : {1.0, 3.0, 10.0, 100.0, 1e4}) {
        const ScatteringMatrix s = scene.total(frequency, near_look(direction, times * unit));
        const double difference = frobenius_norm(s - limit) / frobenius_norm(limit);
        EXPECT_TRUE(difference < before || direction.phi == 0.0);
        before = difference;
        if (times < 1e4) continue;
        EXPECT_LT(level_difference(s.vv(), limit.vv()), 0.01);
        EXPECT_LT(level_difference(s.hh(), limit.hh()), 0.01);
      }
    }
}

// With waves between its faces, which are plane ones here, and with currents that run on over its fold: 0.4 to 2 dB of S.
TEST(FiniteRange, CornerTendsToTheFarFieldWithAllItsWaves) {
  const Scene scene(shapes::dihedral(0.09, 0.09), EdgeMethod::fringe);
  const double diameter = 2 * scene.loaded.mesh.radius, unit = diameter * diameter / wavelength(10e9);
  for (const Direction& direction : {Direction{80 * degree, 33 * degree}, Direction{90 * degree, 45 * degree}}) {
    const ScatteringMatrix limit = scene.total(10e9, {direction, direction});
    const ScatteringMatrix s = scene.total(10e9, near_look(direction, 1e4 * unit));
    EXPECT_LT(level_difference(s.vv(), limit.vv()), 0.01);
    EXPECT_LT(level_difference(s.hh(), limit.hh()), 0.01);
    EXPECT_LT(frobenius_norm(s - limit), 1e-3 * frobenius_norm(limit));
  }
}

// A target away from the origin is seen in another direction than the origin, also where its own size plays no part any more.
TEST(FiniteRange, EdgesOfADistantTargetAreSeenFromWhereItStands) {
  PolygonSoup plate = shapes::transformed(shapes::plate(0.3), glm::dmat3(1.0), 1.0, dvec3(0.0, 50.0, 0.0));
  Scene scene(std::move(plate), EdgeMethod::fringe);
  scene.options.keep_parts = true;
  const Look near = near_look({50 * degree, 0.3}, 940.0), farther = near_look({50 * degree, 0.3}, 945.0);
  const double a = frobenius_norm(scene.solve(10e9, near).of("edges_order_1")[0]),
               b = frobenius_norm(scene.solve(10e9, farther).of("edges_order_1")[0]);
  EXPECT_NEAR(a, b, 0.1 * a);  // the direction changes by .3 mrad, a lobe of edges is 50 mrad wide
}

// A plate of 20 wavelengths from 60, far inside its far field (800): currents and rays are two theories of one field. Rays of
// geometrical optics and of edges (Kouyoumjian & Pathak 1974, with corners) know no waves that run along the plate to the next
// edge; for H along the edge these are some tenths of a decibel. Physical optics alone is off by 1.4 to 9 dB.
TEST(FiniteRange, EdgesAreThoseOfUniformRays) {
  constexpr double frequency = 10e9;
  const double length = wavelength(frequency), range = 60 * length;
  Scene currents(shapes::plate(20 * length), EdgeMethod::fringe), rays(shapes::plate(20 * length), EdgeMethod::utd);
  currents.options.edges.order = 1;
  for (double theta = 25.0; theta <= 65.0; theta += 10.0) {
    const Direction direction{theta * degree, 0.0};
    const ScatteringMatrix s = currents.total(frequency, near_look(direction, range)),
                           expected = rays.total(frequency, near_look(direction, range));
    EXPECT_LT(level_difference(s.hh(), expected.hh()), 0.15) << theta;
    EXPECT_LT(level_difference(s.vv(), expected.vv()), 0.5) << theta;
    EXPECT_LT(std::abs(std::arg(s.hh() / expected.hh())), 0.03) << theta;
    EXPECT_LT(std::abs(std::arg(s.vv() / expected.vv())), 0.05) << theta;
  }
}

// The whole scene turned about the origin, radar and all: the bases of V and H turn differently, the norm of S does not.
// Quadrature that tightens with the tolerance is left: 0.3 per cent of it.
TEST(FiniteRange, TurnsWithTheScene) {
  const glm::dmat3 turn = glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.7, dvec3(0.3, -1.1, 0.45)));
  Scene scene(shapes::box({0.15, 0.10, 0.06}), EdgeMethod::fringe),
      turned(shapes::transformed(shapes::box({0.15, 0.10, 0.06}), turn), EdgeMethod::fringe);
  const dvec3 direction = turn * spherical_basis(oblique).radial;
  const Direction there{std::acos(direction.z), std::atan2(direction.y, direction.x)};
  for (const double tolerance_db : {0.1, 1e-5}) {
    scene.options.tubes.tolerance_db = turned.options.tubes.tolerance_db = tolerance_db;
    const double a = frobenius_norm(scene.total(10e9, near_look(oblique, 0.7))),
                 b = frobenius_norm(turned.total(10e9, near_look(there, 0.7)));
    EXPECT_NEAR(a, b, (std::pow(10.0, tolerance_db / 20.0) - 1.0) * 0.003 * a);
  }
}

// Mesh, wavelength and range a thousand times as large: S, too.
TEST(FiniteRange, ScalesWithEverything) {
  const Scene small(shapes::dihedral(0.15, 0.15), EdgeMethod::fringe),
      large(shapes::transformed(shapes::dihedral(0.15, 0.15), glm::dmat3(1.0), 1000.0), EdgeMethod::fringe);
  const Direction direction{75 * degree, 25 * degree};
  const ScatteringMatrix a = small.total(10e9, near_look(direction, 0.8)), b = large.total(10e6, near_look(direction, 800.0));
  for (int c = 0; c < 4; ++c)  // phases of 1000 roundings
    EXPECT_LT(std::abs(b.at(c / 2, c % 2) * 1e-3 - a.at(c / 2, c % 2)), 1e-10 * frobenius_norm(a));
}

// A Gaussian beam narrow against the plate weighs it: the pattern counts once each way.
TEST(FiniteRange, PatternWeighsTheTarget) {
  const Scene scene(shapes::plate(0.15));
  Radar radar;
  radar.pattern.azimuth_beamwidth = radar.pattern.elevation_beamwidth = 3 * degree;  // 5 cm at 1 m
  constexpr double range = 1.0;
  const double k = wavenumber(10e9);
  const Look look = near_look({0.0, 0.0}, range);
  Complex expected = 0.0;
  constexpr int steps = 400;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const dvec3 r((i + 0.5) / steps * 0.15 - 0.075, (j + 0.5) / steps * 0.15 - 0.075, 0.0);
      const PointWave wave = wave_at(look.transmit, range, r);
      const double off = std::atan(std::hypot(r.x, r.y) / range) / (3 * degree);
      const dvec3 eta_j = 2.0 * glm::cross(dvec3(0, 0, 1), glm::cross(wave.direction, wave.field[0]));
      expected += Complex(0.0, -k / (4.0 * pi)) * glm::dot(wave.field[0], eta_j) *
                  std::exp(-4.0 * std::numbers::ln2 * off * off) *
                  std::polar(0.15 * 0.15 / (double(steps) * steps), -2.0 * k * wave.path);
    }
  EXPECT_LT(std::abs(scene.total(10e9, look, radar).vv() - expected), 1e-3 * std::abs(expected));
}

// Antennas that stand, aimed beside the axis, at a plate that is turned by hand.
TEST(FiniteRange, ATurntableTurnsTheTargetUnderAntennasThatStand) {
  Radar radar;
  radar.pattern.azimuth_beamwidth = 8 * degree, radar.pattern.elevation_beamwidth = 11 * degree;
  radar.aim = {0.05, 0.02, 0.0}, radar.receive_aim = {-0.02, 0.06, 0.01};
  const Look standing = near_look({20 * degree, 10 * degree}, {35 * degree, -30 * degree}, 0.9, 1.2);
  const double turn = 25 * degree;
  Look seen = standing;
  seen.transmit.phi -= turn, seen.receive.phi -= turn, seen.turn = turn;
  Scene turned(shapes::plate(0.15, turn)), plate(shapes::plate(0.15));
  turned.options.tubes.tolerance_db = plate.options.tubes.tolerance_db = 1e-5;
  const ScatteringMatrix by_hand = turned.total(10e9, standing, radar), s = plate.total(10e9, seen, radar);
  EXPECT_LT(frobenius_norm(s - by_hand), 1e-5 * frobenius_norm(by_hand));
  seen.turn = 0.0;  // were the aims to turn with the target
  EXPECT_GT(frobenius_norm(plate.total(10e9, seen, radar) - by_hand), 0.05 * frobenius_norm(by_hand));
}

// Aimed 0.4 m beside a plate of 1 cm: the beam falls by its own law, on that side alone.
TEST(FiniteRange, TheReceiverMayBeAimedElsewhere) {
  const Scene scene(shapes::plate(0.01));
  Radar radar;
  radar.pattern.azimuth_beamwidth = radar.pattern.elevation_beamwidth = 10 * degree;
  const Look look = near_look({10 * degree, 0.0}, {10 * degree, pi}, 4.0, 5.0);
  const ScatteringMatrix on_axis = scene.total(10e9, look, radar);
  radar.receive_aim = dvec3(0.0, 0.4, 0.0);
  const ScatteringMatrix off_axis = scene.total(10e9, look, radar);
  const double expected = radar.pattern.amplitude(std::atan(0.4 / 5.0), 0.0);
  EXPECT_NEAR(std::abs(off_axis.vv() / on_axis.vv()), expected, 1e-3);
}

// The radar equation of a sphere of 1 m, its sigma that of geometrical optics; at 1000 m its image is 0.009 dB too near.
TEST(FiniteRange, ASphereReturnsThePowerOfTheRadarEquation) {
  const Scene scene(shapes::icosphere(4));
  const double frequency = 100.0 * speed_of_light / (2 * pi), range = 1e3, watts = 2e3, gain = 1e3;
  const Look look = near_look({1.1, 2.0}, range);
  const double received =
      LinkBudget{10 * std::log10(watts * 1e3), 30.0}.received_dbm(range, range, frequency, scene.total(frequency, look).vv());
  const double length = wavelength(frequency);
  const double expected = watts * gain * gain * length * length * pi / (std::pow(4 * pi, 3) * std::pow(range, 4));
  EXPECT_NEAR(received, 10 * std::log10(expected * 1e3), 0.06);
}

TEST(FiniteRange, MonostaticIsReciprocalAndThreadsDoNotShow) {
  Scene scene(shapes::dihedral(0.15, 0.15), EdgeMethod::fringe);
  const Look look = near_look({70 * degree, 20 * degree}, 0.5);
  scene.options.threads = 1;
  const ScatteringMatrix one = scene.total(30e9, look);
  EXPECT_EQ(one.vh(), one.hv());
  for (const int threads : {2, 7}) {
    scene.options.threads = threads;
    EXPECT_EQ(scene.total(30e9, look).s, one.s);
  }
}

// With two frequencies each is computed by itself, and triangles are as small as the higher one wants, as among many. These leave
// 1e-12 of what the triangles radiate, which is some hundred times the sum.
TEST(FiniteRange, ManyFrequenciesAreThoseComputedOneByOne) {
  const Scene scene(shapes::dihedral(0.3, 0.3));
  const Look look = near_look({70 * degree, 20 * degree}, 2.0);
  std::vector<double> frequencies;
  for (int i = 0; i < 48; ++i) frequencies.push_back(75e9 + 0.1e9 * i);
  const std::vector<ScatteringMatrix> many = solve(scene.target, {frequencies, {look}}, scene.options).total;
  for (const std::size_t f : {0, 1, 20, 46}) {
    const ScatteringMatrix one = solve(scene.target, {{frequencies[f], frequencies.back()}, {look}}, scene.options).total[0];
    EXPECT_LT(frobenius_norm(many[f] - one), 1e-9 * frobenius_norm(one)) << f;
  }
}

TEST(FiniteRange, RefusesAnAntennaThatHasNotAllOfTheTargetInFront) {
  const Scene scene(shapes::box({0.15, 0.10, 0.06}));
  for (const double range : {1e-3, 0.05, 0.08}) EXPECT_THROW(scene.total(10e9, near_look(oblique, range)), InputError) << range;
  EXPECT_NO_THROW(scene.total(10e9, near_look(oblique, 0.3)));
}

}  // namespace
}  // namespace raytube
