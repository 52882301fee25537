// A strip along a geodesic, on a unit sphere: great circles, and all strips from a point meet again.
#include "utd/surface/geodesic_march.h"

#include <gtest/gtest.h>

#include "run.h"
#include "shapes.h"

namespace raytube {
namespace {

using namespace raytube::testing;

struct MarchedSphere {
  MarchedSphere()
      : target(build_mesh(shapes::icosphere(3), 1.0).mesh),
        smooth(target.mesh, 15 * degree, 0.1),
        surfaces(target.tracer, smooth, true),
        along(glm::cross(surfaces.frame(5, {1.0 / 3, 1.0 / 3}, 1.0).normal, dvec3(0.3, 0.5, 0.8))) {
    along = glm::normalize(along);
  }

  GeodesicMarch march(double sampling = 0.1) const { return {surfaces, {5, {1.0 / 3, 1.0 / 3}}, along, 1.0, sampling}; }

  Target target;
  SmoothSurfaces smooth;
  CurvedTarget surfaces;
  dvec3 along;
};

// Curvatures of the 1280 facets are those of the sphere to 1 %, their sums to less.
TEST(GeodesicMarch, WidthAndBendOfAGreatCircle) {
  const MarchedSphere sphere;
  GeodesicMarch march = sphere.march();
  const dvec3 start = march.position();
  for (double distance = 0.1; distance < 3.0; distance += 0.1) {
    ASSERT_TRUE(march.march_to(distance));
    EXPECT_EQ(march.distance(), distance);
    EXPECT_LE(glm::distance(march.position(), std::cos(distance) * start + std::sin(distance) * sphere.along), 0.02);
    EXPECT_NEAR(march.width().width, std::cos(distance), 0.02);
    EXPECT_NEAR(march.way().bend(), distance * std::cbrt(0.5), 0.01 * distance);
    EXPECT_EQ(march.width().caustics, distance > pi / 2 ? 1 : 0);
  }
}

// Where it is asked to stand changes where the surface is asked for its curvature, not the way: within the change of curvature
// over a facet, 1 %.
TEST(GeodesicMarch, StepsDoNotMatter) {
  const MarchedSphere sphere;
  GeodesicMarch fine = sphere.march(), coarse = sphere.march();
  for (int i = 1; i <= 200; ++i) ASSERT_TRUE(fine.march_to(0.01 * i));
  ASSERT_TRUE(coarse.march_to(2.0));
  EXPECT_LE(glm::distance(fine.position(), coarse.position()), 2e-3);
  EXPECT_NEAR(fine.width().width, coarse.width().width, 0.01);
  EXPECT_NEAR(fine.way().bend(), coarse.way().bend(), 0.01 * fine.way().bend());
}

// At a sliver a curvature of 1e6 made 10 km of a chord of a centimetre, and a strip stood there for ever.
TEST(GeodesicMarch, ArcsAreNoLongerThanHalfACircle) {
  EXPECT_EQ(arc_over(0.1, 0.0), 0.1);
  EXPECT_NEAR(arc_over(0.1, 1.0), 2 * std::asin(0.05), 1e-7);  // the next term, 3 x^5 / 640
  EXPECT_LE(arc_over(0.1, -1e6), 0.1 * pi / 2 * (1 + 1e-12));
}

TEST(GeodesicMarch, StandsAtTheEndOfTheSurface) {
  // Along a cylinder's mantle, 4 high: from its middle it is 2 to the rim, where strips are as wide as ever.
  const Target target(build_mesh(shapes::cylinder(1.0, 4.0, 48), 1.0).mesh);
  const SmoothSurfaces smooth(target.mesh, 15 * degree, 0.1);
  const CurvedTarget surfaces(target.tracer, smooth, true);
  std::uint32_t t = 0;
  while (smooth.region(t) == no_index) ++t;
  GeodesicMarch march(surfaces, {t, {1.0 / 3, 1.0 / 3}}, {0, 0, 1}, 1.0, 0.1);
  const double start = march.position().z;
  EXPECT_FALSE(march.march_to(10.0));
  EXPECT_FALSE(march.lost());
  EXPECT_GE(march.ended_at(), 0);
  EXPECT_NEAR(march.position().z, 2.0, 1e-9);
  EXPECT_NEAR(march.distance(), 2.0 - start, 1e-9);
  EXPECT_NEAR(march.width().width, 1.0, 1e-9);
  EXPECT_NEAR(march.way().bend(), 0.0, 1e-6);
}

}  // namespace
}  // namespace raytube
