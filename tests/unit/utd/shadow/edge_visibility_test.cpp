#include <gtest/gtest.h>

#include "unit/utd_scene.h"
#include "utd/shadow/edge_visibility.h"
#include "utd/shadow/triangle_shadow.h"
#include "utd/wedge/incidence.h"

namespace raytube {
namespace {

using test::Scene;

std::vector<LitInterval> lit_parts(std::span<const Wedge> wedges, std::uint32_t index, const Tracer& tracer,
                                   const dvec3& towards_transmitter, double wavelength) {
  std::vector<LitInterval> lit;
  const WedgeIncidence incidence = incidence_on(wedges[index], -towards_transmitter);
  if (incidence.weight > 0.0)
    EdgeVisibility(wedges, tracer, towards_transmitter, wavelength).find(index, incidence.free_side, lit);
  return lit;
}

/// The edge of a plate along y from -1 to 1, and above it a panel that covers y from `from` to `to` along `direction`; `slant` is
/// how much its borders there run along y.
Scene shaded_edge(const dvec3& direction, double from, double to, double slant = 0.0) {
  Scene scene = test::plate(2, 2);
  scene.wedges.resize(1);
  const dvec3 on_edge(1, (from + to) / 2, 0);
  test::add_panel(scene.mesh, on_edge + 3.0 * direction, dvec3(0.3, slant, 0), dvec3(0, (to - from) / 2, 0));
  return scene;
}

// Clip points are bisected to 1e-13 of the length, each step decided in double on the mesh's own vertices; a shadow edge a few
// metres off adds its rounding, a few 1e-15.
constexpr double clip = 1e-12;

TEST(EdgeVisibility, FreeEdgeIsLitFromEndToEnd) {
  const Scene scene = test::plate(2, 2);
  const Tracer tracer(scene.mesh);
  for (std::uint32_t i = 0; i < scene.wedges.size(); ++i) {
    const auto lit = lit_parts(scene.wedges, i, tracer, glm::normalize(dvec3(0.3, 0.2, 1.0)), 0.1);
    ASSERT_EQ(lit.size(), 1u);
    EXPECT_EQ(lit[0].begin, 0.0);
    EXPECT_EQ(lit[0].end, 1.0);
  }
}

TEST(EdgeVisibility, ShadowIsClippedAtItsEdges) {
  const dvec3 direction = glm::normalize(dvec3(0.1, -0.2, 1.0));
  const Scene scene = shaded_edge(direction, -0.45, 0.233);
  const Tracer tracer(scene.mesh);
  const auto lit = lit_parts(scene.wedges, 0, tracer, direction, 0.5);
  ASSERT_EQ(lit.size(), 2u);
  EXPECT_EQ(lit[0].begin, 0.0);
  EXPECT_NEAR(lit[0].end, (1 - 0.45) / 2, clip);
  EXPECT_NEAR(lit[1].begin, (1 + 0.233) / 2, clip);
  EXPECT_EQ(lit[1].end, 1.0);
}

TEST(EdgeVisibility, ShadowAtAnEndIsFoundBetweenTheLastTwoPoints) {
  const dvec3 direction(0, 0, 1);
  const Scene scene = shaded_edge(direction, 0.97, 1.2);  // covers the last 1.5 % of the edge
  const Tracer tracer(scene.mesh);
  const auto lit = lit_parts(scene.wedges, 0, tracer, direction, 1.0);
  ASSERT_EQ(lit.size(), 1u);
  EXPECT_NEAR(lit[0].end, 1.97 / 2, clip);
}

// Rays start beside the edge, where a shadow with a slanted border is elsewhere; and behind the border of the nearest triangle
// there may be another one.
TEST(EdgeVisibility, ShadowOfSeveralTrianglesIsClippedWhereItMeetsTheEdge) {
  const dvec3 direction = glm::normalize(dvec3(0.1, -0.2, 1.0));
  Scene scene = shaded_edge(direction, -0.45, 0.02, 0.25);
  test::add_panel(scene.mesh, dvec3(1, 0.121, 0) + 2.0 * direction, dvec3(0.3, -0.2, 0), dvec3(0, 0.112, 0));
  const Tracer tracer(scene.mesh);
  const auto lit = lit_parts(scene.wedges, 0, tracer, direction, 0.5);
  ASSERT_EQ(lit.size(), 2u);
  const double beside = 2e-11;  // rays start 1e-11 radii beside the edge, which moves shadows by as much along it
  EXPECT_NEAR(lit[0].end, (1 - 0.45) / 2, beside);
  EXPECT_NEAR(lit[1].begin, (1 + 0.233) / 2, beside);
}

TEST(TriangleShadow, EndsWhereTheTriangleDoesAsSeenFromTheViewpoint) {
  TriangleMesh mesh;
  test::add_panel(mesh, dvec3(0, 0, 1), dvec3(1, 0, 0), dvec3(0, 1, 0));  // triangle 0: below the diagonal x = y
  const dvec3 start(-2, -0.5, 0), end(2, -0.5, 0);
  const TriangleShadow far(mesh, 0, start, end, dvec3(0, 0, 1));
  EXPECT_TRUE(far.hides(0.5));
  EXPECT_FALSE(far.hides(0.37));
  EXPECT_FALSE(far.hides(0.76));
  EXPECT_NEAR(far.end_towards(0.0, 0.5), 1.5 / 4, clip);
  EXPECT_NEAR(far.end_towards(1.0, 0.5), 3.0 / 4, clip);
  const TriangleShadow near(mesh, 0, start, end, Viewpoint::at(dvec3(0, -0.5, 2)));  // twice as wide
  EXPECT_NEAR(near.end_towards(0.0, 0.5), 1.0 / 4, clip);
  EXPECT_NEAR(near.end_towards(1.0, 0.5), 4.0 / 4, clip);
  EXPECT_FALSE(TriangleShadow(mesh, 0, start, end, dvec3(0, 0, -1)).hides(0.5));                                    // behind
  EXPECT_FALSE(TriangleShadow(mesh, 0, start, end, dvec3(1, 0, 0)).hides(0.5));                                     // edge-on
  EXPECT_TRUE(TriangleShadow(mesh, 0, start + dvec3(0, 0, 2), end + dvec3(0, 0, 0.5), dvec3(0, 0, 1)).hides(0.7));  // pierced
  EXPECT_FALSE(TriangleShadow(mesh, 0, start + dvec3(0, 0, 2), end + dvec3(0, 0, 0.5), dvec3(0, 0, 1)).hides(0.6));
}

TEST(EdgeVisibility, FullShadowAndTurnedAway) {
  const dvec3 direction(0, 0, 1);
  const Scene scene = shaded_edge(direction, -1.5, 1.5);
  const Tracer tracer(scene.mesh);
  EXPECT_TRUE(lit_parts(scene.wedges, 0, tracer, direction, 1.0).empty());
  EXPECT_EQ(lit_parts(scene.wedges, 0, tracer, -direction, 1.0).size(), 1u);
  const Scene box = test::cube(1);
  const Tracer box_tracer(box.mesh);
  int lit = 0;
  for (std::uint32_t i = 0; i < box.wedges.size(); ++i)
    lit += !lit_parts(box.wedges, i, box_tracer, glm::normalize(dvec3(1, 2, 3)), 1.0).empty();
  EXPECT_EQ(lit, 9);
}

TEST(EdgeVisibility, EdgesOverAGrazedFaceAreLit) {
  // Face-on, rays from the four far edges run along a side face: they start a hair above it and are free.
  const Scene box = test::cube(1);
  const Tracer tracer(box.mesh);
  int exposed = 0, half = 0;
  for (std::uint32_t i = 0; i < box.wedges.size(); ++i) {
    const WedgeIncidence incidence = incidence_on(box.wedges[i], dvec3(-1, 0, 0));
    const auto lit = lit_parts(box.wedges, i, tracer, dvec3(1, 0, 0), 0.1);
    EXPECT_EQ(lit.size(), incidence.weight > 0 ? 1u : 0u);
    exposed += incidence.weight == 1.0;
    half += incidence.weight == 0.5;
  }
  EXPECT_EQ(exposed, 4);
  EXPECT_EQ(half, 4);
}

TEST(EdgeVisibility, ShadowsMuchNarrowerThanTheSpacingAreFound) {
  // A slat that hides 1e-4 of an edge of two wavelengths, and one that leaves only as much lit: both are bounded by wedges.
  const dvec3 direction = glm::normalize(dvec3(0.1, -0.2, 1.0));
  for (const auto& [from, to] : {std::pair{0.3331, 0.3333}, std::pair{-1.2, 0.9998}}) {
    Scene scene = shaded_edge(direction, from, to);
    const dvec3 middle = dvec3(1, (from + to) / 2, 0) + 3.0 * direction, half(0, (to - from) / 2, 0), x(0.3, 0, 0);
    for (const double side : {-1.0, 1.0})
      scene.wedges.push_back(test::half_plane(middle + side * half - x, middle + side * half + x, -side * glm::normalize(half),
                                              dvec3(0, 0, 1), to - from, 1));
    const Tracer tracer(scene.mesh);
    const auto lit = lit_parts(scene.wedges, 0, tracer, direction, 1.0);
    double sum = 0.0;
    for (const LitInterval& part : lit) sum += part.end - part.begin;
    EXPECT_NEAR(sum, 1 - (to - std::max(from, -1.0)) / 2, clip) << from;
  }
}

}  // namespace
}  // namespace raytube
