// Solid angles of what a point sees, against closed forms.
#include <gtest/gtest.h>

#include "shapes.h"
#include "source_scene.h"

namespace raytube {
namespace {

using namespace raytube::testing;

// Sums of some tens of arc tangents; cuts are exact to 1e-11 of the scene.
constexpr double rounding = 1e-10;

double rectangle(double width, double height, double distance) {
  // Of a rectangle as seen from the axis through its middle (Mathar 2003, eq. 27).
  const double a = width / (2 * distance), b = height / (2 * distance);
  return 4.0 * std::asin(a * b / std::sqrt((1 + a * a) * (1 + b * b)));
}

TEST(SolidAngle, OctantAndCubeFaceAndRectangle) {
  EXPECT_NEAR(solid_angle({1, 0, 0}, {0, 2, 0}, {0, 0, 3}), pi / 2, 1e-15);
  EXPECT_NEAR(solid_angle({{1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}}, dvec3(0.0)), 4 * pi / 6, 1e-14);
  EXPECT_NEAR(solid_angle({{3, -1, -2}, {3, 1, -2}, {3, 1, 2}, {3, -1, 2}}, dvec3(0.0)), rectangle(2, 4, 3), 1e-14);
  // Nearly the half space, where the denominator is negative; the arc sine, close to 1, loses some digits there.
  EXPECT_NEAR(solid_angle({{1e-3, -9, -9}, {1e-3, 9, -9}, {1e-3, 9, 9}, {1e-3, -9, 9}}, dvec3(0.0)), rectangle(18, 18, 1e-3),
              1e-11);
}

TEST(SolidAngle, WallsOfAClosedRoomShareTheSphere) {
  const SourceScene room({shapes::cube(2.0)});
  EXPECT_NEAR(room.exact({0, 0, 0})[0], 1.0, rounding);
  EXPECT_NEAR(room.exact({0.3, -0.7, 0.99})[0], 1.0, rounding);
}

TEST(SolidAngle, OfAConvexBodyIsThatOfTheFacesTowardsThePoint) {
  // From the axis of one face all others are hidden behind it.
  const SourceScene body({shapes::box({2, 4, 6})});
  EXPECT_NEAR(body.exact({4, 0, 0})[0], rectangle(4, 6, 3) / (4 * pi), rounding);
}

TEST(SourceVisibility, ScreenBehindAWindowOfAThinWall) {
  // The wall leaves a window of 0.2 x 0.2 on the axis, 1 m off; the screen, 2 m off, is wider than its cone.
  const SourceScene scene({plate_across_x(2, {-1, -1}, {1, 1}), plate_across_x(1, {-3, -3}, {3, -0.1}),
                           plate_across_x(1, {-3, 0.1}, {3, 3}), plate_across_x(1, {-3, -0.1}, {-0.1, 0.1}),
                           plate_across_x(1, {0.1, -0.1}, {3, 0.1})});
  EXPECT_NEAR(scene.exact({0, 0, 0})[0], rectangle(0.2, 0.2, 1) / (4 * pi), rounding);
}

TEST(SourceVisibility, PlatesThatCrossHideHalfOfEachOther) {
  // Two squares of side 2 crossing on the z axis at +-45 degrees to the line of sight: the near halves hide the far ones, so that
  // together they cover what the near halves do.
  const double h = std::numbers::sqrt2 / 2;
  const auto square = [&](double sense) {
    return PolygonSoup{{{-h, -sense * h, -1}, {h, sense * h, -1}, {h, sense * h, 1}, {-h, -sense * h, 1}},
                       {{0, 1, 2}, {0, 2, 3}}};
  };
  const dvec3 from(-3, 0, 0);
  const std::vector<double> share = SourceScene({square(1), square(-1)}).exact(from);
  const double half = solid_angle({{0, 0, -1}, {-h, -h, -1}, {-h, -h, 1}, {0, 0, 1}}, from) / (4 * pi);
  EXPECT_NEAR(share[0], half, rounding);
  EXPECT_NEAR(share[1], half, rounding);
}

TEST(SourceVisibility, OneOfTwoCoincidentPlatesCounts) {
  const SourceScene scene({plate_across_x(1, {-1, -1}, {1, 1}), plate_across_x(1, {-1, -1}, {1, 1})});
  const std::vector<double> share = scene.exact({0, 0, 0});
  EXPECT_NEAR(share[0] + share[1], 1.0 / 6.0, rounding);
}

TEST(SourceVisibility, ParallelRaysSeeProjectedAreas) {
  // A plate of 1 x 1 half hidden by another one, and what lies behind the plane they start from.
  const SourceScene scene(
      {plate_across_x(2, {0, 0}, {1, 1}), plate_across_x(1, {0.5, -1}, {2, 2}), plate_across_x(-1, {-5, -5}, {5, 5})});
  const dvec3 start = dvec3(0, 0, 0) - scene.joined.mesh.center;
  std::vector<double> areas(3, 0.0);
  for (const VisiblePiece& piece : visible_pieces(scene.joined.mesh, {start, dvec3(1, 0, 0)}))
    areas[scene.joined.triangle_part[piece.triangle]] += area(piece.outline);
  EXPECT_NEAR(areas[0], 0.5, rounding);
  EXPECT_NEAR(areas[1], 4.5, rounding);
  EXPECT_EQ(areas[2], 0.0);
}

TEST(SourceVisibility, BordersOfASquareAreItsFourSides) {
  // The diagonal between its two triangles is none.
  const SourceScene scene({plate_across_x(1, {-1, -1}, {1, 1})});
  double length = 0.0;
  for (const VisiblePiece& piece : visible_pieces(scene.joined.mesh, {dvec3(-3, 0, 0), {}}))
    for (const Segment& border : piece.border) length += glm::length(border.to - border.from);
  EXPECT_NEAR(length, 8.0, 1e-9);
}

TEST(SourceVisibility, AngleAreaAgainstClosedForms) {
  const dvec3 origin(0.0);
  // An octant has a quarter turn of azimuth and of elevation, above and below the horizon alike.
  EXPECT_NEAR(angle_area({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, origin, 1e-12), pi * pi / 4, 1e-12);
  EXPECT_NEAR(angle_area({{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, origin, 1e-12), pi * pi / 4, 1e-12);
  // The walls of a room fill the plane of angles, wherever the pole pierces them.
  const SourceScene room({shapes::cube(2.0)});
  for (const dvec3& source : {dvec3(0, 0, 0), dvec3(0.31, -0.72, 0.9)}) {
    double sum = 0.0;
    for (const VisiblePiece& piece : visible_pieces(room.joined.mesh, {source, {}}))
      sum += angle_area(piece.outline, source, 1e-12);
    EXPECT_NEAR(sum, 2 * pi * pi, 1e-9);  // the tolerance of the integrals times their number
  }
}

}  // namespace
}  // namespace raytube
