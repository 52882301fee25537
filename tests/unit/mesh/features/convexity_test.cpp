// What stands in front of a face, and what does not.
#include "mesh/features/convexity.h"

#include "mesh/read/formats.h"
#include "unit/mesh_shapes.h"

namespace raytube {
namespace {

Convexity convexity(const PolygonSoup& soup) {
  const LoadedMesh loaded = shapes::build(soup);
  return find_convexity(loaded.mesh);
}

PolygonSoup turned(const PolygonSoup& soup) { return shapes::moved(soup, shapes::skew_rotation(), {3.0, -1.0, 2.0}); }

TEST(Convexity, ConvexBodiesHaveNeitherReflectionNorShadow) {
  for (const PolygonSoup& soup :
       {shapes::cube(), shapes::remeshed(shapes::cube(), 3, 4), shapes::cylinder(40), shapes::sphere(20)})
    for (const PolygonSoup& placed : {soup, turned(soup)}) {
      const Convexity found = convexity(placed);
      EXPECT_TRUE(found.no_reflection);
      EXPECT_TRUE(found.no_shadow);
    }
}

// A sphere in a binary STL file a metre off its origin: facets rise above one another by the rounding, and by no more.
TEST(Convexity, RoundingIsNoHollow) {
  PolygonSoup soup = shapes::in_single_precision(shapes::moved(shapes::sphere(40), shapes::skew_rotation(), {30.0, -10.0, 20.0}));
  EXPECT_FALSE(convexity(soup).no_reflection);
  soup.step = coordinate_step(soup.points, 0);
  EXPECT_TRUE(convexity(soup).no_reflection);
  soup.points[100] *= 0.9999;  // of a point thirty away: a dent of 3e-3
  EXPECT_FALSE(convexity(soup).no_reflection);
}

TEST(Convexity, PlatesDoNotReflectOnThemselves) {
  const PolygonSoup plate = shapes::plate({0, 0, 0}, {1, 0.2, 0}, {0, 1, 0.5});
  EXPECT_TRUE(convexity(plate).no_reflection);
  EXPECT_FALSE(convexity(plate).no_shadow);  // claimed of closed bodies alone
  EXPECT_TRUE(convexity(shapes::joined(plate, shapes::moved(plate, glm::dmat3(1.0), {3, 0.6, 0}))).no_reflection);
  EXPECT_FALSE(convexity(shapes::joined(plate, shapes::moved(plate, glm::dmat3(1.0), {3, 0.6, 1e-9}))).no_reflection);
}

TEST(Convexity, NotTwoBodiesNotHollowsNotCorners) {
  const PolygonSoup cube = shapes::cube();
  const PolygonSoup lee = shapes::prism({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 1.0);
  const PolygonSoup corner = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}}};
  const PolygonSoup roof = {{{0, 0, 0}, {1, 0, 0}, {1, 1, -0.1}, {0, 1, -0.1}, {1, -1, -0.1}, {0, -1, -0.1}},
                            {{0, 1, 2, 3}, {0, 5, 4, 1}}};
  for (const PolygonSoup& soup : {shapes::joined(cube, shapes::moved(cube, glm::dmat3(1.0), {3, 0, 0})), lee, corner, roof,
                                  shapes::joined(shapes::box(dvec3(0.0), dvec3(3.0)), shapes::box(dvec3(1.0), dvec3(2.0)))}) {
    EXPECT_FALSE(convexity(soup).no_reflection);
    EXPECT_FALSE(convexity(soup).no_shadow);
  }
}

// A dent a thousandth of a facet's width deep: shallow, but rays do meet across it.
TEST(Convexity, ShallowDentsCount) {
  PolygonSoup dented = shapes::sphere(20);
  EXPECT_TRUE(convexity(dented).no_reflection);
  for (dvec3& p : dented.points)
    if (glm::distance(p, dvec3(1, 0, 0)) < 1e-9) p *= 0.98;
  EXPECT_FALSE(convexity(dented).no_reflection);
}

// Edges all convex, and yet the faces go round the tips twice: a five-pointed star with a hub, as a double cone.
TEST(Convexity, SurfacesThatCoverThemselvesDoNotPass) {
  PolygonSoup star;
  for (int i = 0; i < 5; ++i) star.points.push_back({std::cos(0.8 * pi * i), std::sin(0.8 * pi * i), 0.0});
  star.points.push_back({0, 0, 1});
  star.points.push_back({0, 0, -1});
  for (std::uint32_t i = 0; i < 5; ++i) {
    star.polygons.push_back({i, (i + 1) % 5, 5});
    star.polygons.push_back({(i + 1) % 5, i, 6});
  }
  EXPECT_FALSE(convexity(star).no_reflection);
}

}  // namespace
}  // namespace raytube
