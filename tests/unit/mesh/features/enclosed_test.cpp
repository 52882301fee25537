// What lies inside a closed body, and what only seems to.
#include <gmock/gmock.h>

#include "mesh/features/enclosed.h"
#include "unit/mesh_shapes.h"

namespace raytube {
namespace {

using ::testing::ElementsAre;

std::vector<bool> enclosed(const PolygonSoup& soup) {
  const LoadedMesh loaded = shapes::build(soup);
  return find_enclosed_components(FaceTree(loaded.mesh));
}

const PolygonSoup hull = shapes::box(dvec3(-1.0), dvec3(1.0));

TEST(Enclosed, BodiesAndSheetsInsideABody) {
  PolygonSoup soup = shapes::joined(shapes::box(dvec3(-0.3), dvec3(0.2)), hull);
  shapes::append(soup, shapes::plate({0.4, -0.5, -0.5}, {0.1, 0.5, 0}, {0, 0, 0.7}));
  EXPECT_THAT(enclosed(soup), ElementsAre(true, false, true));
  EXPECT_THAT(enclosed(shapes::moved(soup, shapes::skew_rotation(), {5, -3, 2})), ElementsAre(true, false, true));
}

TEST(Enclosed, InsideOneOfTwoBodies) {
  const PolygonSoup inner = shapes::box(dvec3(-0.5), dvec3(0.5)), innermost = shapes::box(dvec3(-0.1), dvec3(0.1));
  EXPECT_THAT(enclosed(shapes::joined(shapes::joined(innermost, inner), hull)), ElementsAre(true, true, false));
  EXPECT_THAT(enclosed(shapes::joined(shapes::moved(innermost, glm::dmat3(1.0), {5, 0, 0}), hull)), ElementsAre(false, false));
}

TEST(Enclosed, NotWhatPassesThroughTheSkinOrLiesOnIt) {
  EXPECT_THAT(enclosed(shapes::joined(shapes::box(dvec3(-0.3), dvec3(0.2, 0.2, 1.5)), hull)), ElementsAre(false, false));
  EXPECT_THAT(enclosed(shapes::joined(shapes::box(dvec3(-0.3), dvec3(0.2, 0.2, 1.0 - 1e-7)), hull)), ElementsAre(false, false));
}

// Through a slope that lies above the foot of what passes it.
TEST(Enclosed, NotWhatPassesThroughASlope) {
  const PolygonSoup octahedron{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                               {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  const auto post = [](double top) { return shapes::box(dvec3(0.28, -0.02, -0.5), dvec3(0.32, 0.02, top)); };
  EXPECT_THAT(enclosed(shapes::joined(octahedron, post(0.5))), ElementsAre(false, true));
  EXPECT_THAT(enclosed(shapes::joined(octahedron, post(0.9))), ElementsAre(false, false));
}

// In the hollow between the arms of an L: inside its box, outside the body. And within a box that is open on one side.
TEST(Enclosed, NotInHollows) {
  const PolygonSoup lee = shapes::prism({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, 2.0);
  EXPECT_THAT(enclosed(shapes::joined(lee, shapes::box(dvec3(1.5, 1.5, 0.5), dvec3(2, 2, 1)))), ElementsAre(false, false));
  EXPECT_THAT(enclosed(shapes::joined(lee, shapes::box(dvec3(0.2, 1.5, 0.5), dvec3(0.8, 2, 1)))), ElementsAre(false, true));
  PolygonSoup open = hull;
  open.polygons.pop_back();
  EXPECT_THAT(enclosed(shapes::joined(open, shapes::box(dvec3(-0.3), dvec3(0.2)))), ElementsAre(false, false));
}

// Each of a thousand blocks in a sphere of 160 000 facets.
TEST(Enclosed, EachOfManyBodies) {
  PolygonSoup soup = shapes::sphere(200);
  for (int i = 0; i < 1000; ++i) {
    const dvec3 at(0.1 * (i % 10) - 0.45, 0.1 * (i / 10 % 10) - 0.45, 0.1 * (i / 100) - 0.45);
    shapes::append(soup, shapes::box(at - 0.01, at + 0.01));
  }
  std::vector<bool> expected(1001, true);
  expected[0] = false;
  EXPECT_EQ(enclosed(soup), expected);
}

}  // namespace
}  // namespace raytube
