// Which edges may illuminate other faces, and at which of their ends another surface stands.
#include "utd/interaction/edge_axes.h"

#include <gtest/gtest.h>

#include "unit/mesh_shapes.h"

namespace raytube {
namespace {

struct Body {
  explicit Body(const PolygonSoup& soup) : loaded(shapes::build(soup)), wedges(shapes::wedges_of(loaded)) {}
  std::vector<EdgeAxis> axes() const { return edge_axes(loaded.mesh, wedges, {}); }
  LoadedMesh loaded;
  std::vector<Wedge> wedges;
};

PolygonSoup dihedral() {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {0, 1, 0}, {0, 1, 1}}, {{0, 1, 2, 3}, {0, 3, 5, 4}}};
}
PolygonSoup trihedral() { return shapes::joined(dihedral(), shapes::plate({0, 0, 0}, {0, 1, 0}, {1, 0, 0})); }
PolygonSoup l_shape() { return shapes::prism({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 1.0); }

dvec3 at(const EdgeAxis& axis, int end) { return axis.origin + (end == 0 ? 0.0 : axis.length) * axis.tangent; }

/// How many faces of the wedge meet another surface, at both ends together.
int abutting(const EdgeAxis& axis) { return static_cast<int>(axis.abutting_faces[0].size() + axis.abutting_faces[1].size()); }

void expect_consistent(const Body& body) {
  const dvec3 center = body.loaded.mesh.center;
  for (const EdgeAxis& axis : body.axes()) {
    const Wedge& wedge = *axis.wedge;
    EXPECT_GT(wedge.n, 1.0);
    EXPECT_NEAR(glm::distance(glm::cross(wedge.faces[0].into_face, wedge.faces[0].normal), axis.tangent), 0.0, 1e-14);
    EXPECT_EQ(axis.origin, axis.reversed() ? wedge.end : wedge.start) << center.x;
    EXPECT_NEAR(glm::distance(at(axis, 1), axis.reversed() ? wedge.start : wedge.end), 0.0, 1e-14);
  }
}

TEST(EdgeAxes, NoneOnConvexBodies) {
  for (const PolygonSoup& soup :
       {shapes::cube(), shapes::cylinder(24), shapes::sphere(6), shapes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0})})
    EXPECT_TRUE(Body(soup).axes().empty());
}

TEST(EdgeAxes, OfADihedralAbutInItsInnerEdge) {
  const Body body(dihedral());
  const std::vector<EdgeAxis> axes = body.axes();
  expect_consistent(body);
  // Three outer edges of each face; in front of the outer side of the inner edge there is nothing.
  ASSERT_EQ(axes.size(), 6u);
  for (const EdgeAxis& axis : axes) {
    const dvec3 center = body.loaded.mesh.center;
    int at_inner_edge = 0;
    for (int end = 0; end < 2; ++end) {
      const dvec3 point = at(axis, end) + center;
      const bool inner = std::hypot(point.x, point.y) < 1e-12;
      at_inner_edge += inner;
      // The other plate stands on the inner side of this one alone.
      EXPECT_EQ(axis.abutting_faces[static_cast<std::size_t>(end)].size(), inner ? 1u : 0u);
      for (const int face : axis.abutting_faces[static_cast<std::size_t>(end)]) {
        const dvec3 inside(1, 1, 0);
        EXPECT_GT(glm::dot(axis.wedge->faces[static_cast<std::size_t>(face)].normal, inside), 0.5);
      }
    }
    EXPECT_LE(at_inner_edge, 1);
  }
}

TEST(EdgeAxes, OfATrihedralAbutInEveryInnerEdge) {
  const Body body(trihedral());
  const std::vector<EdgeAxis> axes = body.axes();
  expect_consistent(body);
  ASSERT_EQ(axes.size(), 6u);  // two outer edges of each face, each from an inner edge to a free corner
  for (const EdgeAxis& axis : axes) EXPECT_EQ(abutting(axis), 1);
}

TEST(EdgeAxes, OfABodyWithOneConcaveEdge) {
  const Body body(l_shape());
  const std::vector<EdgeAxis> axes = body.axes();
  expect_consistent(body);
  // The notch lies in front of its own two walls' outer edges (2), and by their edges with top and bottom (4). What faces past it
  // does not count.
  ASSERT_EQ(axes.size(), 6u);
  int meeting = 0;
  for (const EdgeAxis& axis : axes) {
    EXPECT_NEAR(axis.wedge->n, 1.5, 1e-12);
    meeting += abutting(axis);
  }
  EXPECT_EQ(meeting, 4);  // the four edges along top and bottom end at the concave edge, each with its wall
}

TEST(EdgeAxes, OfBodiesSideBySide) {
  // In front of all four edges of the face between two cubes there is the other cube; in front of others there is nothing.
  const Body body(shapes::joined(shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({2, 0, 0}, {3, 1, 1})));
  const std::vector<EdgeAxis> axes = body.axes();
  expect_consistent(body);
  ASSERT_EQ(axes.size(), 8u);
  for (const EdgeAxis& axis : axes) EXPECT_EQ(abutting(axis), 0);
}

}  // namespace
}  // namespace raytube
