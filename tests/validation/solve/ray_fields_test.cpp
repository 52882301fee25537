// edges.method = "utd": rays in the place of currents, at a finite distance.
#include "gtd/ray_fields.h"

#include <gtest/gtest.h>

#include <random>

#include "core/error.h"
#include "run.h"
#include "shapes.h"
#include "utd/wedge/diffracted_field.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double frequency = speed_of_light, k = 2 * pi;  // wavelength 1 m

SolveOptions at_range(double range) {
  SolveOptions o = options(EdgeMethod::utd);
  o.edges.utd_range = range;
  return o;
}

Sweep bistatic(const Direction& transmit, const Direction& receive) { return {{frequency}, {{transmit, receive}}, true}; }

/// A plate in z = 0 from x = 0 to 2 and y = -1 to 1.
PolygonSoup plate_beside_the_origin() { return {{{0, -1, 0}, {2, -1, 0}, {2, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}; }

void expect_near(Complex found, Complex expected, double tolerance, const char* what) {
  EXPECT_LE(std::abs(found - expected), tolerance) << what << ": " << found << ", expected " << expected;
}

// From an image behind a mirror the field at the receiver is that over the whole way: |S| = range^2 / way.
TEST(RayFields, PlateAtNormalIncidenceReadsItsImage) {
  PolygonSoup soup = shapes::plate(3);
  const double height = 0.3, range = 12;
  for (dvec3& point : soup.points) point.z = height;
  const SweepResult result = solve_soup(soup, monostatic({{0, 0}}, frequency), at_range(range));
  const Complex image = -std::polar(range * range / (2 * (range - height)), 2 * k * height);
  // Rounding of phases k range = 75, 1e-14 each.
  expect_near(result.bounces[0][0].vv(), image, 1e-10, "V");
  expect_near(result.bounces[0][0].hh(), image, 1e-10, "H");
  EXPECT_EQ(result.bounces.size(), 1u);
}

TEST(RayFields, EdgesOfARectangleTurnItsMirrorIntoItsFarField) {
  // The image alone reads range / 2. In the far zone all edges and corners lie within the transition of its light; edges cut
  // sharply would leave -1 of it, edges with all of a corner's wave +1. Shared between the two edges that meet there, range / 2
  // goes and what stays is -j area / lambda of physical optics; the next order has opposite signs in V and H. 1e-3: area / range
  // is 6e-5, rounding of range^2 times phases k range is 2e-4.
  PolygonSoup soup{{{-1.1, -1.3, 0}, {1.9, -1.3, 0}, {1.9, 0.7, 0}, {-1.1, 0.7, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const ScatteringMatrix s = solve_soup(soup, monostatic({{0, 0}}, frequency), at_range(1e5)).total[0];
  expect_near(0.5 * (s.vv() + s.hh()), Complex(0, -6), 1e-3, "mean of V and H");
  EXPECT_LE(std::abs(s.vv() - s.hh()), 0.5);  // soft and hard edge waves of four edges, some 0.1 m each
}

TEST(RayFields, CornersReadHalfTheRange) {
  // All orders of the faces are one wave, at -1 times the position of the source: E across the inner edge of a dihedral turns
  // round, E along it and in a trihedral comes back as it was.
  const double range = 40;
  for (const double phi : {20.0, 45.0, 73.0}) {
    const SweepResult s =
        solve_soup(shapes::dihedral(3, 3), monostatic({{90 * degree, phi * degree}}, frequency), at_range(range));
    expect_near(s.bounces.at(1)[0].vv(), range / 2, 1e-10, "dihedral, V");
    expect_near(s.bounces.at(1)[0].hh(), -range / 2, 1e-10, "dihedral, H");
  }
  const SweepResult s = solve_soup(shapes::trihedral(4), monostatic({{0.9, 0.8}}, frequency), at_range(range));
  ASSERT_EQ(s.bounces.size(), 3u);
  expect_near(s.bounces[2][0].vv(), range / 2, 1e-10, "trihedral, V");
  expect_near(s.bounces[2][0].hh(), range / 2, 1e-10, "trihedral, H");
}

// A plate whose middle is not the origin of its coordinates.
TEST(RayFields, EdgesOfAPlateAreThoseOfThePublicFunction) {
  const double range = 30, h = 1.5;
  const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), middle(4, -2, 1);
  const StraightEdge edges[] = {{middle + h * x, -x, z, 2.0, -h, h},
                                {middle - h * x, x, z, 2.0, -h, h},
                                {middle + h * y, -y, z, 2.0, -h, h},
                                {middle - h * y, y, z, 2.0, -h, h}};
  const Direction from{40 * degree, 20 * degree}, to{65 * degree, 170 * degree};
  const SphericalBasis transmit = spherical_basis(from), receive = spherical_basis(to);
  PolygonSoup soup = shapes::plate(2 * h);
  for (dvec3& point : soup.points) point += middle;
  const SweepResult found = solve_soup(soup, bistatic(from, to), at_range(range));
  for (const int q : {0, 1}) {
    const RaySource source{Spreading::point, range * transmit.radial, z, {q == 0 ? transmit.theta_hat : transmit.phi_hat, {}}};
    ComplexVector sum;
    for (const StraightEdge& edge : edges) sum += diffracted_field(edge, source, range * receive.radial, k);
    sum = std::polar(range * range, 2 * k * range) * sum;
    // Rounding of phases k range = 190; the sum is some 5 m.
    expect_near(found.of("edges_order_1")[0].at(0, q), dot(sum, receive.theta_hat), 1e-10, "received V");
    expect_near(found.of("edges_order_1")[0].at(1, q), dot(sum, receive.phi_hat), 1e-10, "received H");
  }
}

// Where the light of one ray ends the edge's own changes sides; exactly there the ray counts half and the edge nothing.
void expect_continuous(const Direction& transmit, double receive_theta, double receive_phi) {
  const double range = 20;
  const auto at = [&](double theta) {
    return solve_soup(plate_beside_the_origin(), bistatic(transmit, {theta, receive_phi}), at_range(range));
  };
  const SweepResult before = at(receive_theta - 1e-8), on = at(receive_theta), after = at(receive_theta + 1e-8);
  // The total changes by about k range |S| a radian; half a ray is 5 m.
  EXPECT_LE(largest_amplitude(before.total[0] - after.total[0]), 1e-4);
  EXPECT_LE(largest_amplitude(before.total[0] - on.total[0]), 1e-4);
  const auto rays = [](const SweepResult& r) { return r.bounces.empty() ? 0.0 : std::abs(r.bounces[0][0].vv()); };
  EXPECT_GT(std::abs(rays(before) - rays(after)), 4.0);
  EXPECT_NEAR(rays(on), (rays(before) + rays(after)) / 2, 1e-4);
}

TEST(RayFields, ReflectedRayEndsAtTheRimWithoutAJump) { expect_continuous({30 * degree, 0}, 30 * degree, pi); }

TEST(RayFields, ShadowEndsAtTheRimWithoutAJump) { expect_continuous({30 * degree, 0}, 150 * degree, pi); }

TEST(RayFields, NothingArrivesBehindALargePlate) {
  // In the middle of the shadow, 60 wavelengths wide and as far away, only the edges are left: four times 1 / (2 sqrt(pi) z) with
  // z = sqrt(2 kL) sin 27 degrees = 9.2, kL = 210, over a way 134/120 as long: 0.11 of the incident field.
  const SweepResult s = solve_soup(shapes::plate(60), bistatic({0, 0}, {pi, 0}), at_range(60));
  const Complex incident = -60.0 * 60.0 / 120.0;  // of the direct ray; theta_hat has turned round
  EXPECT_LE(std::abs(s.total[0].vv() + incident), 0.11 * std::abs(incident));
  EXPECT_EQ(s.bounces[0][0].vv(), -incident);
}

TEST(RayFields, BistaticLooksAreReciprocal) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> theta(0.05, pi - 0.05), phi(-pi, pi);
  for (const PolygonSoup& soup : {shapes::cube(2), shapes::dihedral(3, 3)})
    for (int i = 0; i < 20; ++i) {
      const Direction a{theta(random), phi(random)}, b{theta(random), phi(random)};
      const ScatteringMatrix there = solve_soup(soup, bistatic(a, b), at_range(25)).total[0];
      const ScatteringMatrix back = solve_soup(soup, bistatic(b, a), at_range(25)).total[0];
      for (const int p : {0, 1})
        for (const int q : {0, 1}) expect_near(there.at(p, q), back.at(q, p), 1e-9, "reciprocity");  // rounding of phases
    }
}

// --- antennas at a finite distance ---

Sweep between(const Direction& transmit, const Direction& receive, double transmit_range, double receive_range) {
  return {{frequency}, {{transmit, receive, transmit_range, receive_range}}, true};
}

// One behind the other above a mirror: |S| = product of the ranges / way, and a Gaussian beam that looks beside it counts twice.
TEST(RayFields, AntennasReadAMirrorFromWhereTheyStand) {
  PolygonSoup soup = shapes::plate(3);
  const double height = 0.3, near = 12, far = 17, off = 4 * degree;
  for (dvec3& point : soup.points) point.z = height;
  Sweep sweep = between({0, 0}, {0, 0}, near, far);
  const Complex image = -std::polar(near * far / (near + far - 2 * height), 2 * k * height);
  expect_near(solve_soup(soup, sweep, options(EdgeMethod::utd)).bounces[0][0].vv(), image, 1e-10, "V");
  sweep.radar.pattern.azimuth_beamwidth = sweep.radar.pattern.elevation_beamwidth = 2 * off;
  sweep.radar.aim = {near * std::tan(off), 0, 0};
  const double beside = std::atan(near * std::tan(off) / far);  // of the farther one
  const auto level = [&](double angle) { return std::exp(-std::numbers::ln2 / 2 * std::pow(angle / off, 2)); };
  const Complex weighed = image * level(off) * level(beside);
  expect_near(solve_soup(soup, sweep, options(EdgeMethod::utd)).bounces[0][0].hh(), weighed, 1e-10, "beside the beam");
}

// At a corner all orders of the faces are one wave, which comes straight back: as from the same range without [radar].
TEST(RayFields, AntennasReadCornersAsRaysOfTheirRangeDo) {
  for (const double phi : {20.0, 45.0, 73.0}) {
    const Direction d{90 * degree, phi * degree};
    const ScatteringMatrix s =
        solve_soup(shapes::dihedral(3, 3), between(d, d, 40, 40), options(EdgeMethod::utd)).bounces.at(1)[0];
    expect_near(s.vv(), 20, 1e-10, "V");
    expect_near(s.hh(), -20, 1e-10, "H");
  }
}

// Fields turned with the rays differ from those of the line to the origin by the square of the angle, (1.5 / 3e3)^2, of a sum of
// 1 m to 10 m; distances enter the phases of both alike.
TEST(RayFields, FarAntennasAreThoseOfTheRange) {
  const Direction from{40 * degree, 20 * degree}, to{65 * degree, 170 * degree};
  const double range = 3e3;
  for (const PolygonSoup& soup : {shapes::cube(2), shapes::dihedral(3, 3), shapes::plate(3)}) {
    const ScatteringMatrix near = solve_soup(soup, between(from, to, range, range), options(EdgeMethod::utd)).total[0],
                           expected = solve_soup(soup, bistatic(from, to), at_range(range)).total[0];
    EXPECT_LE(frobenius_norm(near - expected), 1e-3 * frobenius_norm(expected));
  }
}

TEST(RayFields, AntennasAreReciprocal) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> theta(0.05, pi - 0.05), phi(-pi, pi), range(9.0, 30.0);
  for (const PolygonSoup& soup : {shapes::cube(2), shapes::dihedral(3, 3)})
    for (int i = 0; i < 20; ++i) {
      const Direction a{theta(random), phi(random)}, b{theta(random), phi(random)};
      const double to_a = range(random), to_b = range(random);
      const ScatteringMatrix there = solve_soup(soup, between(a, b, to_a, to_b), options(EdgeMethod::utd)).total[0],
                             back = solve_soup(soup, between(b, a, to_b, to_a), options(EdgeMethod::utd)).total[0];
      for (const int p : {0, 1})
        for (const int q : {0, 1}) expect_near(there.at(p, q), back.at(q, p), 1e-9, "reciprocity");
    }
}

TEST(RayFields, TargetBeyondTheRangeIsRefused) {
  EXPECT_THROW(solve_soup(shapes::plate(3), monostatic({{0, 0}}, frequency), at_range(2.0)), InputError);
  EXPECT_THROW(solve_soup(shapes::plate(3), monostatic({{0, 0}}, frequency), at_range(-1.0)), InputError);
  // Left to itself: ten times 2 D^2 / lambda, D^2 = 18.
  const SweepResult s = solve_soup(shapes::plate(3), monostatic({{0, 0}}, frequency), at_range(0.0));
  EXPECT_NEAR(s.statistics.ray_range, 360.0, 1e-9);
}

}  // namespace
}  // namespace raytube
