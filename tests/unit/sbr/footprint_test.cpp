// A bundle of tubes on a plane: area, current, phase, and the beam that leaves.
#include <gtest/gtest.h>

#include "sbr/beams/footprint.h"
#include "scene/material.h"

namespace raytube {
namespace {

constexpr double k = 20.0;  // [1/m] wavelength 0.31 m
constexpr double rounding = 1e-13;

// A tilted plane off the origin under an oblique wave, seen bistatically: nothing cancels by symmetry.
struct Scene {
  SphericalBasis transmit = spherical_basis({0.5, 0.8}), receive = spherical_basis({0.9, -0.4});
  Patch patch{glm::normalize(dvec3(0.3, -0.2, 1.0)), 0.35};
  dvec2 reference{0.15, -0.25};
  LaunchGrid grid = made_grid();
  Beam incident = incident_beam(grid, transmit, reference);
  Footprint onto = footprint(incident, patch, receive);

  LaunchGrid made_grid() const {
    LaunchGrid g;
    g.u_hat = transmit.phi_hat;
    g.v_hat = -transmit.theta_hat;
    g.direction = -transmit.radial;
    g.plane_origin = 5.0 * transmit.radial;
    return g;
  }

  // Where the ray of launch coordinates (u, v) meets the plane, found by nothing but that.
  dvec3 point(const dvec2& at) const {
    const dvec3 start = grid.plane_origin + at.x * grid.u_hat + at.y * grid.v_hat;
    return start + grid.direction * ((patch.offset - glm::dot(start, patch.normal)) / glm::dot(grid.direction, patch.normal));
  }

  // k (s - s').r of the radiation integral on the surface.
  double exponent(const dvec2& at) const { return k * glm::dot(receive.radial - grid.direction, point(at)); }
};

// Integral over the lit surface by the midpoint rule; launch cells are stretched by 1 / |n.d| on it.
Complex by_quadrature(const Scene& scene, const dvec2& center, double width, double height, int steps) {
  Complex sum = 0.0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const dvec2 offset((i + 0.5) / steps - 0.5, (j + 0.5) / steps - 0.5);
      sum += std::polar(1.0, scene.exponent(scene.reference + center + offset * dvec2(width, height)));
    }
  const double stretch = 1.0 / std::abs(glm::dot(scene.grid.direction, scene.patch.normal));
  return sum * (stretch * width * height / (double(steps) * steps));
}

TEST(Footprint, LiesOnThePlaneWhereItsRaysMeetIt) {
  const Scene scene;
  for (const dvec2 offset : {dvec2(0, 0), dvec2(0.3, 0), dvec2(0, -0.2), dvec2(0.1, 0.4)}) {
    const Beam& on_plane = scene.onto.outgoing;
    const dvec3 point = on_plane.base + offset.x * on_plane.along_u + offset.y * on_plane.along_v;
    EXPECT_NEAR(glm::dot(point, scene.patch.normal), scene.patch.offset, rounding);
    EXPECT_NEAR(glm::distance(point, scene.point(scene.reference + offset)), 0.0, rounding);
  }
}

TEST(Footprint, IntegralIsTheQuadratureWithItsPhase) {
  const Scene scene;
  const dvec2 center(0.2, -0.1);
  const double width = 0.6, height = 0.4;
  const Complex closed = phase_integral(scene.onto, k, scene.reference + center, width, height);
  // Midpoint rule: its error falls as steps^-2; Richardson takes that term away.
  const Complex coarse = by_quadrature(scene, center, width, height, 200);
  const Complex fine = by_quadrature(scene, center, width, height, 400);
  EXPECT_GT(std::abs(closed), 1e-3);
  EXPECT_NEAR(std::abs((4.0 * fine - coarse) / 3.0 - closed), 0.0, 1e-9);
}

TEST(Footprint, ARunOfCellsIsTheSumOfItsCells) {
  const Scene scene;
  const double du = 0.031, dv = 0.029;
  for (const int cells : {2, 7, 40}) {
    Complex sum = 0.0;
    for (int i = 0; i < cells; ++i)
      sum += phase_integral(scene.onto, k, scene.reference + dvec2{0.1 + (i + 0.5) * du, 0.05}, du, dv);
    const Complex run = phase_integral(scene.onto, k, scene.reference + dvec2{0.1 + 0.5 * cells * du, 0.05}, cells * du, dv);
    EXPECT_NEAR(std::abs(sum - run), 0.0, 1e-13 * cells * du * dv) << cells;
  }
}

// The wave before and after reflection has the same phase everywhere on the plane: d.r + path.
TEST(Footprint, ReflectionKeepsThePhaseOnThePlane) {
  const Scene scene;
  const Beam& before = scene.incident;
  const Beam& after = scene.onto.outgoing;
  EXPECT_NEAR(glm::length(after.direction), 1.0, rounding);
  EXPECT_EQ(before.path, 0.0);
  EXPECT_GT(std::abs(after.path), 0.1);
  for (const dvec2 at : {dvec2(0, 0), dvec2(1, 0), dvec2(-2, 3)}) {
    const dvec3 r = scene.point(at);
    EXPECT_NEAR(glm::dot(after.direction, r) + after.path, glm::dot(before.direction, r) + before.path, rounding);
  }
}

// On a perfect conductor the tangential electric field vanishes; the reflected wave is transverse and loses nothing.
TEST(Footprint, ReflectedFieldMeetsTheBoundaryCondition) {
  const Scene scene;
  for (int q = 0; q < 2; ++q) {
    const dvec3 before = scene.incident.field[q], after = scene.onto.outgoing.field[q];
    EXPECT_NEAR(glm::length(glm::cross(scene.patch.normal, before + after)), 0.0, rounding);
    EXPECT_NEAR(glm::dot(after, scene.onto.outgoing.direction), 0.0, rounding);
    EXPECT_NEAR(glm::length(after), 1.0, rounding);
  }
}

// A sheet is lit from the side the wave comes from, however its facets are wound.
TEST(Footprint, NormalSideOfTheSheetDoesNotMatter) {
  const Scene scene;
  const Footprint other = footprint(scene.incident, {-scene.patch.normal, -scene.patch.offset}, scene.receive);
  EXPECT_EQ(other.area, scene.onto.area);
  EXPECT_EQ(other.phase, scene.onto.phase);
  EXPECT_EQ(other.weight, scene.onto.weight);
  EXPECT_EQ(other.outgoing.path, scene.onto.outgoing.path);
}

// J = 2 n x H radiating broadside: |S| = A / lambda in both co-polarised channels, none across.
TEST(Footprint, FarFieldOfAPlateAtBroadside) {
  Scene scene;
  scene.transmit = scene.receive = spherical_basis({0.0, 0.0});
  scene.patch = {dvec3(0, 0, 1), 0.0};
  scene.grid = scene.made_grid();
  const Footprint onto = footprint(incident_beam(scene.grid, scene.transmit, {0.0, 0.0}), scene.patch, scene.receive);
  ScatteringMatrix s;
  add_far_field(s, onto, 0, k, phase_integral(onto, k, {0.0, 0.0}, 0.6, 0.5));
  const Complex expected(0.0, -k * 0.3 / (2.0 * pi));
  EXPECT_NEAR(std::abs(s.vv() - expected), 0.0, rounding);
  EXPECT_NEAR(std::abs(s.hh() - expected), 0.0, rounding);
  EXPECT_EQ(std::abs(s.vh()) + std::abs(s.hv()), 0.0);
}

}  // namespace
}  // namespace raytube
