// Mirror planes of a target, however its faces are cut into triangles.
#include <gmock/gmock.h>

#include <algorithm>

#include "mesh/features/symmetry.h"
#include "unit/mesh_shapes.h"

namespace raytube {
namespace {

using ::testing::ElementsAre;

std::array<bool, 3> planes(const PolygonSoup& soup) {
  const LoadedMesh loaded = shapes::build(soup);
  return find_symmetry_planes(loaded.mesh, shapes::wedges_of(loaded));
}

std::array<bool, 3> facet_planes(const PolygonSoup& soup) {
  const LoadedMesh loaded = shapes::build(soup);
  return find_symmetry_planes(loaded.mesh, shapes::wedges_of(loaded), true);
}

TEST(Symmetry, BoxesAndSpheresHaveAllThree) {
  EXPECT_THAT(planes(shapes::cube()), ElementsAre(true, true, true));
  EXPECT_THAT(planes(shapes::box({-1, 3, 0.1}, {2, 3.5, 7})), ElementsAre(true, true, true));
  EXPECT_THAT(planes(shapes::sphere(12)), ElementsAre(true, true, true));
  EXPECT_THAT(planes(shapes::cylinder(12)), ElementsAre(true, true, true));
}

// Facets in another order and cut along other diagonals: the faces are the same.
TEST(Symmetry, DiagonalsDoNotMatter) {
  PolygonSoup cube = shapes::cube();
  cube.polygons[0] = {0, 2, 3};
  cube.polygons.push_back({0, 3, 1});
  cube.polygons[2] = {1, 5, 4};
  cube.polygons.push_back({1, 4, 0});
  EXPECT_THAT(planes(cube), ElementsAre(true, true, true));
  EXPECT_THAT(facet_planes(cube), ElementsAre(false, false, false));
  EXPECT_THAT(planes(shapes::remeshed(shapes::cube(), 2, 2)), ElementsAre(true, true, true));
}

TEST(Symmetry, AWedgeHasTheOneItHas) {
  EXPECT_THAT(planes(shapes::prism({{0, 0}, {4, 0}, {0, 1}}, 2.0)), ElementsAre(false, false, true));
  EXPECT_THAT(planes(shapes::prism({{-1, 0}, {1, 0}, {0, 2}}, 2.0)), ElementsAre(true, false, true));
}

// Open surfaces are wound as most of their triangles are, which need not be a mirror image.
TEST(Symmetry, OpenSurfacesAreTheSameFromBothSides) {
  const PolygonSoup corner = {{{0, 0, -1}, {1, 1, -1}, {1, 1, 1}, {0, 0, 1}, {-1, 1, -1}, {-1, 1, 1}},
                              {{0, 1, 2, 3}, {0, 4, 5, 3}}};
  EXPECT_THAT(planes(corner), ElementsAre(true, false, true));
}

TEST(Symmetry, WhatIsNearlyOrPartlyAnImageIsNone) {
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), 1e-6, dvec3(0, 0, 1)));
  EXPECT_THAT(planes(shapes::moved(shapes::cube(), turn)), ElementsAre(false, false, true));
  EXPECT_THAT(planes(shapes::moved(shapes::cube(), shapes::skew_rotation())), ElementsAre(false, false, false));
  // The same corners, one face missing.
  PolygonSoup open = shapes::cube();
  open.polygons.erase(open.polygons.begin());  // at the lowest z
  EXPECT_THAT(planes(open), ElementsAre(true, true, false));
}

// One wedge left out, as where a crease is by rounding flatter than the limit.
TEST(Symmetry, WedgesCountAsWell) {
  const LoadedMesh loaded = shapes::build(shapes::cube());
  std::vector<Wedge> wedges = shapes::wedges_of(loaded);
  ASSERT_EQ(wedges.size(), 12u);
  const auto on_x = std::ranges::find_if(wedges, [](const Wedge& w) { return w.start.x == w.end.x && w.start.y == w.end.y; });
  wedges.erase(on_x);  // along z
  EXPECT_THAT(find_symmetry_planes(loaded.mesh, wedges), ElementsAre(false, false, true));
}

// Far from the origin of its coordinates a target keeps its symmetry, as far as they are exact.
TEST(Symmetry, ThePlanesRunThroughTheMiddleOfTheTarget) {
  EXPECT_THAT(planes(shapes::moved(shapes::prism({{-1, 0}, {1, 0}, {0, 2}}, 2.0), glm::dmat3(1.0), {1000.3, -20.7, 0.1})),
              ElementsAre(true, false, true));
}

}  // namespace
}  // namespace raytube
