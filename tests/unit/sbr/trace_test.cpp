// One tube replayed: its bounces, its path, why it ended.
#include <gtest/gtest.h>

#include "core/error.h"
#include "sbr/replay.h"
#include "shapes.h"

namespace raytube {
namespace {

constexpr double frequency = 3e9;   // [Hz]
constexpr double rounding = 1e-12;  // [m] distances of a few metres through a handful of operations

void expect_near(const dvec3& a, const dvec3& b) { EXPECT_NEAR(glm::distance(a, b), 0.0, rounding); }

struct Replay {
  LoadedMesh loaded;
  TubeOptions options;

  TubeTrace at(const Direction& look, double u, double v) const {
    return trace_tube({Tracer(loaded.mesh)}, {look, look}, frequency, options, {u, v});
  }
};

Replay replay(const PolygonSoup& soup, const dvec3& shift = dvec3(0.0)) {
  return {build_mesh(shapes::transformed(soup, glm::dmat3(1.0), 1.0, shift), 1.0), {}};
}

// Faces of 1 m on +x and +y, seen at 30 degrees from the x axis: u = phi_hat points from the x face to the y face, and rays
// arrive along (-cos, -sin).
const Direction into_dihedral{90 * degree, 30 * degree};
const double c = std::cos(30 * degree), s = std::sin(30 * degree);

TEST(TraceTube, DihedralReturnsTheRayAfterTwoBounces) {
  const Replay dihedral = replay(shapes::dihedral(1.0, 1.0));
  const TubeTrace trace = dihedral.at(into_dihedral, -0.2, 0.1);
  ASSERT_EQ(trace.bounces.size(), 2u);
  EXPECT_EQ(trace.end, "left the scene");
  const dvec3 incident(-c, -s, 0);
  const TubeBounce &first = trace.bounces[0], &second = trace.bounces[1];

  // The ray leaves 0.0041 and 0.0073 of a cell beside the cell's centre; a cell is a tenth of the wavelength of 0.1 m.
  const dvec3 center = dihedral.loaded.mesh.center, u_hat(-s, c, 0);
  EXPECT_NEAR(glm::dot(first.point + center, u_hat), trace.center.x, 0.005 * 0.01);
  EXPECT_NEAR(first.point.z, trace.center.y, 0.008 * 0.01);
  EXPECT_NEAR(first.point.y + center.y, 0.0, rounding);   // the x face, in the plane y = 0
  EXPECT_NEAR(second.point.x + center.x, 0.0, rounding);  // the y face, in the plane x = 0
  expect_near(first.normal, dvec3(0, 1, 0));
  expect_near(second.normal, dvec3(1, 0, 0));
  expect_near(first.direction_out, dvec3(-c, s, 0));
  expect_near(second.direction_out, -incident);
  expect_near(glm::normalize(second.point - first.point), first.direction_out);
  EXPECT_NE(first.patch, second.patch);
}

// Both planes pass through the mesh's origin, so every tube's way there and back is that of the fold: path + s'.r of the wave
// that leaves is zero at the origin.
TEST(TraceTube, DihedralPathIsThatOfItsCorner) {
  const Replay dihedral = replay(shapes::dihedral(1.0, 1.0));
  for (const double u : {-0.1, -0.2, -0.4}) {
    const TubeTrace trace = dihedral.at(into_dihedral, u, 0.0);
    ASSERT_EQ(trace.bounces.size(), 2u);
    const TubeBounce& last = trace.bounces[1];
    const dvec3 point = last.point + dihedral.loaded.mesh.center;
    EXPECT_NEAR(last.path + glm::dot(point, -last.direction_out), 0.0, rounding) << u;
  }
}

// E along the fold turns over at each face: after two it is back. E across the fold comes back turned over once more.
TEST(TraceTube, DihedralFieldAfterTwoReflections) {
  const TubeTrace trace = replay(shapes::dihedral(1.0, 1.0)).at(into_dihedral, -0.2, 0.0);
  ASSERT_EQ(trace.bounces.size(), 2u);
  const SphericalBasis basis = spherical_basis(into_dihedral);
  expect_near(trace.bounces[0].field[0].re, -basis.theta_hat);
  expect_near(trace.bounces[1].field[0].re, basis.theta_hat);
  expect_near(trace.bounces[1].field[1].re, -basis.phi_hat);
}

TEST(TraceTube, SaysWhenItWasCut) {
  Replay dihedral = replay(shapes::dihedral(1.0, 1.0));
  dihedral.options.max_bounces = 1;
  const TubeTrace trace = dihedral.at(into_dihedral, -0.2, 0.0);
  EXPECT_EQ(trace.bounces.size(), 1u);
  EXPECT_EQ(trace.end, "cut at tubes.max_bounces");
}

TEST(TraceTube, ATubeBesideTheTargetMeetsNothing) {
  // The grid covers the rectangle around the triangle's projection, and (u, v) = (0.9, 0.9) is its empty half.
  const Replay triangle = replay({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  const TubeTrace trace = triangle.at({0.0, 0.0}, 0.9, -0.9);
  EXPECT_TRUE(trace.bounces.empty());
  EXPECT_EQ(trace.end, "left the scene");
}

TEST(TraceTube, CoordinatesCountFromTheMeshsOwnOrigin) {
  const dvec3 shift(7.0, -3.0, 0.5);
  const Replay here = replay(shapes::dihedral(1.0, 1.0)), there = replay(shapes::dihedral(1.0, 1.0), shift);
  const dvec2 moved(glm::dot(shift, dvec3(-s, c, 0)), shift.z);
  const TubeTrace a = here.at(into_dihedral, -0.2, 0.1), b = there.at(into_dihedral, -0.2 + moved.x, 0.1 + moved.y);
  EXPECT_EQ(a.column, b.column);
  EXPECT_EQ(a.row, b.row);
  EXPECT_NEAR(glm::distance(a.center + moved, b.center), 0.0, rounding);
  EXPECT_LE(std::abs(a.center.x + 0.2), 0.01);  // half a cell and less from what was asked for
  ASSERT_EQ(a.bounces.size(), b.bounces.size());
  expect_near(a.bounces[0].point + here.loaded.mesh.center + shift, b.bounces[0].point + there.loaded.mesh.center);
  EXPECT_THROW(there.at(into_dihedral, -0.2, 0.1), InputError);
}

TEST(TraceTube, PathIsMeasuredFromThePlaneThroughTheMeshsOrigin) {
  const Replay plate = replay(shapes::plate(1.0), dvec3(2.0, 1.0, 10.0));
  const TubeTrace trace = plate.at({0.0, 0.0}, 1.0, -2.0);  // u = phi_hat = +y, v = -theta_hat = -x
  ASSERT_EQ(trace.bounces.size(), 1u);
  EXPECT_NEAR(trace.bounces[0].path, -10.0, rounding);  // the wave meets the plate 10 m before the origin
}

}  // namespace
}  // namespace raytube
