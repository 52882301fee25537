// Which open surfaces look like bodies with holes, and what is said of them.
#include <gmock/gmock.h>

#include "mesh/load.h"
#include "mesh/soundness/open_bodies.h"
#include "output/words/warnings.h"
#include "shapes.h"

namespace raytube {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Faces of boxes are pairs of triangles.
PolygonSoup without_face(PolygonSoup soup, int face) {
  soup.polygons.erase(soup.polygons.begin() + 2 * face, soup.polygons.begin() + 2 * face + 2);
  return soup;
}

PolygonSoup without_facet(PolygonSoup soup, int facet) {
  soup.polygons.erase(soup.polygons.begin() + facet);
  return soup;
}

OpenBodies bodies_of(const PolygonSoup& soup, const std::vector<Material>& materials = {}) {
  const TriangleMesh mesh = build_mesh(soup, 1e-3, "test", materials).mesh;
  return find_open_bodies(mesh, std::vector<bool>(mesh.components.size(), false), materials);
}

constexpr double rounding = 1e-12;  // of coordinates of about 1 m

TEST(OpenBodies, ABoxWithoutAFace) {
  const OpenBodies open = bodies_of(without_face(shapes::cube(300.0), 0));
  EXPECT_EQ(open.count, 1u);
  EXPECT_EQ(open.holes, 1u);
  EXPECT_DOUBLE_EQ(open.share, 1.0);
  EXPECT_NEAR(open.area, 5 * 0.09, rounding);
  EXPECT_NEAR(open.largest.border, 1.2, rounding);
  EXPECT_NEAR(open.largest.area, 0.09, rounding);
  EXPECT_NEAR(glm::length(open.largest.middle), 0.15, rounding);
}

// However finely it is meshed, a surface that is meant to be open is none; nor is a closed body.
TEST(OpenBodies, OpenSurfacesAreNone) {
  const PolygonSoup ball = shapes::icosphere(3, 300.0);
  PolygonSoup bowl = ball;
  std::erase_if(bowl.polygons, [&](const auto& polygon) {
    return ball.points[polygon[0]].z + ball.points[polygon[1]].z + ball.points[polygon[2]].z > 0.0;
  });
  for (const PolygonSoup& soup : {shapes::plate(300.0), shapes::tiled_plate(300.0, 8), shapes::dihedral(300.0, 100.0),
                                  shapes::trihedral(300.0), shapes::cube(300.0), ball, bowl})
    EXPECT_EQ(bodies_of(soup).count, 0u) << soup.polygons.size();
}

TEST(OpenBodies, AConeWithoutItsBase) {
  EXPECT_EQ(bodies_of(shapes::cone(100.0, 400.0, 36, false)).count, 1u);  // its base would be a quarter of its wall
  EXPECT_EQ(bodies_of(shapes::cone(100.0, 100.0, 36, false)).count, 0u);  // 0.7 of it: a dish
}

TEST(OpenBodies, HolesAreCountedByTheirBorders) {
  const PolygonSoup ball = shapes::icosphere(3, 300.0);
  EXPECT_EQ(bodies_of(without_facet(without_facet(ball, 700), 0)).holes, 2u);
  EXPECT_EQ(bodies_of(without_face(without_face(shapes::box({3000.0, 300.0, 300.0}), 5), 4)).holes, 2u);  // a duct
  EXPECT_EQ(bodies_of(without_face(without_face(shapes::cube(300.0), 1), 0)).count, 0u);  // half of the wall is missing
}

TEST(OpenBodies, ThoseBehindSheetsAndInsideBodiesAreNone) {
  PolygonSoup box = without_face(shapes::cube(300.0), 0);
  const std::vector<Material> film{{"film", MaterialKind::thin_sheet, 0.0, {}, 100.0}};
  box.materials.assign(box.polygons.size(), no_index);
  EXPECT_EQ(bodies_of(box, film).count, 1u);
  box.materials.back() = 0;
  EXPECT_EQ(bodies_of(box, film).count, 0u);
  EXPECT_EQ(find_open_bodies(build_mesh(box, 1.0, "test").mesh, {true}, {}).count, 0u);
}

TEST(OpenBodies, WordsInTheUnitOfTheMesh) {
  const PolygonSoup box =
      shapes::transformed(without_face(shapes::cube(300.0), 0), glm::dmat3(1.0), 1.0, dvec3(1000.0, 0.0, 0.0));
  const OpenBodies one = bodies_of(box);
  const std::vector<std::string> sentences = open_body_warnings(one, {1e-3, "mm"});
  EXPECT_THAT(sentences,
              ElementsAre(HasSubstr("open bodies: component 0, 100 % of the surface, is closed except for a hole: 90000 "
                                    "mm^2 beside 450000 mm^2 of surface, with a border of 1200 mm round (")));
  const OpenBodies two = bodies_of(shapes::joined(without_face(shapes::cube(100.0), 0), box));
  EXPECT_THAT(
      open_body_warnings(two, {1e-3, "mm"}),
      ElementsAre(HasSubstr("open bodies: 2 components, 100 % of the surface, are closed except for 2 holes; the largest, in "
                            "component 1, is 90000 mm^2")));
  EXPECT_THAT(open_body_warnings({}, {1e-3, "mm"}), IsEmpty());
}

// A bolt without its lower end beside a truck is not told.
TEST(OpenBodies, SmallOnesAreNotTold) {
  const OpenBodies bolt = bodies_of(shapes::joined(shapes::transformed(shapes::cube(1000.0), glm::dmat3(1.0), 1.0, dvec3(2000.0)),
                                                   without_face(shapes::cube(10.0), 0)));
  EXPECT_EQ(bolt.count, 1u);
  EXPECT_THAT(open_body_warnings(bolt, {1e-3, "mm"}), IsEmpty());
}

}  // namespace
}  // namespace raytube
