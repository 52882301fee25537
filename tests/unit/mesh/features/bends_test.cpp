// Which steep creases are bends of a curved surface, and which are edges.
#include "mesh/smooth/bends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "mesh/features/wedges.h"
#include "mesh/load.h"
#include "mesh/smooth/smooth.h"
#include "plan/target.h"
#include "unit/mesh_shapes.h"

namespace raytube {
namespace {

using namespace raytube::shapes;

constexpr double crease = 15.0 * degree;

std::vector<Bend> bends_of(const TriangleMesh& mesh, double threshold) { return find_bends(mesh, threshold); }

std::vector<Bend> bends_of(const PolygonSoup& soup) { return bends_of(build(soup).mesh, crease); }

// Prism on an outline, counter-clockwise in t from 0 to 2 pi.
PolygonSoup over(const std::function<dvec2(double)>& outline, int sides) {
  std::vector<dvec2> points;
  for (int i = 0; i < sides; ++i) points.push_back(outline(2.0 * pi * i / sides));
  return prism(points, 0.5);
}

dvec2 ellipse(double t) { return {3.0 * std::cos(t), std::sin(t)}; }

// At its noses an ellipse of 3:1 in 32 chords turns by 33 degrees and beside them by 25, 14, 8: nothing but its rims are edges.
TEST(Bends, NosesOfCoarseEllipsesAreNoEdges) {
  const LoadedMesh loaded = build(over(ellipse, 32));
  const std::vector<Bend> bends = bends_of(loaded.mesh, crease);
  EXPECT_GE(bends.size(), 6u);
  EXPECT_GT(std::ranges::max(bends, {}, &Bend::angle).angle, 30 * degree);
  const Target target(loaded.mesh);
  for (const Wedge& wedge : target.wedges) EXPECT_NEAR(wedge.n, 1.5, 1e-9);
}

// They tell with which angles facets lean there: the surface over them rises to the ellipse.
TEST(Bends, FacetsBesideThemAreCurved) {
  const Target target(build(over(ellipse, 32)).mesh);
  const SmoothSurfaces smooth(target.mesh, target.options.min_wedge_angle);
  for (std::uint32_t t = 0; t < target.mesh.triangles.size(); ++t) {
    if (std::abs(target.mesh.patch_of(t).normal.z) > 0.5) continue;
    ASSERT_NE(smooth.region(t), no_index);
    EXPECT_GT(smooth.rise(t), 0.0);
  }
}

TEST(Bends, EdgesOfPolyhedraAreNone) {
  EXPECT_TRUE(bends_of(cube()).empty());
  for (const int sides : {6, 8, 12, 16, 20}) EXPECT_TRUE(bends_of(cylinder(sides)).empty()) << sides;
}

// Walls of tessellation do not turn across the rim.
TEST(Bends, RimsBesideCurvedFacesAreNone) { EXPECT_TRUE(bends_of(cylinder(72)).empty()); }

// Two arcs of 120 degrees in chords of 4 meet at 56: what they turn by next to the edge does not explain it.
TEST(Bends, EdgesOfLensesAreNone) {
  const auto lens = [](double t) {
    const bool upper = t < pi;
    const double along = (upper ? t : t - pi) / pi;  // 0 to 1 over an arc
    const double angle = (30.0 + 120.0 * along) * degree;
    const dvec2 point = dvec2(std::cos(angle), std::sin(angle) - 0.5);
    return upper ? point : -point;
  };
  EXPECT_TRUE(bends_of(over(lens, 64)).empty());
}

// Fillets of chords end in planes: the wave may see one rounded edge, and as facets they are what was drawn.
TEST(Bends, FilletsBetweenPlanesAreNone) {
  const auto fillet = [](int chords) {
    std::vector<dvec2> points{{0.0, 0.0}, {2.0, 0.0}};
    for (int i = 0; i <= chords; ++i) {
      const double angle = std::min(90.0, i * 90.0 / chords) * degree;
      points.push_back({1.9 + 0.1 * std::cos(angle), 1.9 + 0.1 * std::sin(angle)});
    }
    points.push_back({0.0, 2.0});
    return prism(points, 0.5);
  };
  for (const int chords : {2, 3, 4, 5}) EXPECT_TRUE(bends_of(fillet(chords)).empty()) << chords;
}

// A surface that is flatter than wedges everywhere has none; neither has one whose wedges all count.
TEST(Bends, HangOnTheThreshold) {
  const LoadedMesh loaded = build(over(ellipse, 32));
  EXPECT_TRUE(bends_of(loaded.mesh, 40 * degree).empty());
  EXPECT_TRUE(bends_of(loaded.mesh, 0.0).empty());
}

}  // namespace
}  // namespace raytube
