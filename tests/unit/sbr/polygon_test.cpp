// Convex polygons of the launch plane: cuts, phase integrals, cells beneath.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sbr/beams/polygon_integral.h"

namespace raytube {
namespace {

constexpr double rounding = 1e-14;  // a few operations on numbers of order one

ConvexPolygon polygon(const std::vector<dvec2>& corners) {
  ConvexPolygon p;
  set_corners(p, corners);
  return p;
}

// Corners on a circle at random angles.
ConvexPolygon random_polygon(std::mt19937& random, int corners) {
  std::uniform_real_distribution<double> angle(0.0, 2 * pi);
  std::vector<double> angles;
  for (int i = 0; i < corners; ++i) angles.push_back(angle(random));
  std::ranges::sort(angles);
  std::vector<dvec2> points;
  for (const double a : angles) points.emplace_back(std::cos(a), std::sin(a));
  return polygon(points);
}

double area_or_zero(const ConvexPolygon& p) { return p.empty() ? 0.0 : area(p); }

TEST(ConvexPolygon, RunsCounterClockwiseHoweverGiven) {
  EXPECT_EQ(area(polygon({{0, 0}, {2, 0}, {0, 1}})), 1.0);
  EXPECT_EQ(area(polygon({{0, 0}, {0, 1}, {2, 0}})), 1.0);
}

TEST(ConvexPolygon, PartsOfACutAddUp) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  ConvexPolygon positive, negative;
  for (int i = 0; i < 2000; ++i) {
    const ConvexPolygon p = random_polygon(random, 3 + i % 9);
    const Affine line{0.7 * number(random), number(random), number(random)};
    cut(p, line, 1e-15, positive, negative);
    EXPECT_NEAR(area_or_zero(positive) + area_or_zero(negative), area(p), rounding);
    for (const Corner& corner : positive) EXPECT_GE(line(corner.at), -rounding);
    for (const Corner& corner : negative) EXPECT_LE(line(corner.at), rounding);
    for (const ConvexPolygon& part : {positive, negative})
      for (const Corner& corner : part) EXPECT_GE(range(part, corner.edge).low, -rounding);
  }
}

TEST(ConvexPolygon, ACutAlongAnEdgeOrThroughACornerMakesNoSliver) {
  const ConvexPolygon square = polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  ConvexPolygon positive, negative;
  for (const double beside : {0.0, 1e-16, -1e-16}) {
    cut(square, {beside, 1.0, 0.0}, 1e-15, positive, negative);  // along u = 0
    EXPECT_EQ(positive.size(), 4u);
    EXPECT_TRUE(negative.empty());
    cut(square, {beside, 1.0, -1.0}, 1e-15, positive, negative);  // the diagonal
    EXPECT_EQ(positive.size(), 3u);
    EXPECT_EQ(negative.size(), 3u);
    cut(square, {beside - 2.0, 1.0, 1.0}, 1e-15, positive, negative);  // touches the corner (1, 1)
    EXPECT_TRUE(positive.empty());
    EXPECT_EQ(negative.size(), 4u);
  }
}

// Two corners a rounding apart say nothing about their edge's direction; the line it was cut along does.
TEST(ConvexPolygon, AShortEdgeKeepsItsLine) {
  ConvexPolygon corner, rest;
  cut(polygon({{0, 0}, {1, 0}, {0, 1}}), {1e-13, -1.0, -1.0}, 1e-16, corner, rest);  // cuts off a corner of size 1e-13
  ASSERT_EQ(corner.size(), 3u);
  for (const Corner& c : corner) {
    const double along_u = std::abs(c.edge.u), along_v = std::abs(c.edge.v);
    EXPECT_TRUE(along_u == 0.0 || along_v == 0.0 || std::abs(along_u - along_v) < rounding);
  }
}

Footprint with_gradient(double u, double v) {
  Footprint f;
  f.area = 1.0;
  f.phase_u = u;
  f.phase_v = v;
  f.outgoing.anchor = {0.0, 0.0};
  return f;
}

// Gauss-Legendre with 16 points on strips short against the phase.
Complex by_quadrature(const dvec2& a, const dvec2& b, const dvec2& c, const dvec2& gradient) {
  static const std::array<double, 8> x = {0.0950125098376374, 0.2816035507792589, 0.4580167776572274, 0.6178762444026438,
                                          0.7554044083550030, 0.8656312023878318, 0.9445750230732326, 0.9894009349916499};
  static const std::array<double, 8> w = {0.1894506104550685, 0.1826034150449236, 0.1691565193950025, 0.1495959888165767,
                                          0.1246289712555339, 0.0951585116824928, 0.0622535239386479, 0.0271524594117541};
  Complex sum = 0.0;
  const auto each = [&](auto&& function) {
    for (std::size_t i = 0; i < 8; ++i) function(0.5 - 0.5 * x[i], 0.5 * w[i]), function(0.5 + 0.5 * x[i], 0.5 * w[i]);
  };
  each([&](double s, double ws) {
    each([&](double t, double wt) {
      const dvec2 p = a + s * ((b - a) + t * (c - b));  // Duffy: the triangle as a square with one side shrunk to a point
      sum += ws * wt * s * std::polar(1.0, glm::dot(gradient, p));
    });
  });
  return sum * std::abs((b - a).x * (c - a).y - (b - a).y * (c - a).x);
}

TEST(PolygonIntegral, IsTheQuadratureOfATriangle) {
  const dvec2 a(0.1, -0.3), b(0.9, 0.2), c(-0.2, 0.7);
  const std::array<dvec2, 3> corners{a, b, c};
  const ConvexPolygon p = polygon({a, b, c});
  for (const double size : {0.0, 1e-12, 1e-6, 1e-3, 0.1, 0.4, 0.6, 1.0, 5.0, 12.0})
    for (int i = 0; i < 24; ++i) {
      dvec2 gradient = size * dvec2(std::cos(i * pi / 12), std::sin(i * pi / 12));
      if (i % 8 == 0) {  // constant along an edge
        const dvec2 edge = corners[(i / 8 + 1) % 3] - corners[i / 8];
        gradient = size * glm::normalize(dvec2(-edge.y, edge.x));
      }
      const Complex closed = phase_integral(with_gradient(gradient.x, gradient.y), 1.0, p);
      EXPECT_NEAR(std::abs(closed - by_quadrature(a, b, c, gradient)), 0.0, 1e-14) << size << ' ' << i;
    }
}

TEST(PolygonIntegral, OfARectangleIsTwoSincs) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (const double size : {0.0, 1e-9, 1e-3, 0.3, 1.0, 10.0, 1e3, 1e6, 1e8})
    for (int i = 0; i < 50; ++i) {
      const dvec2 center(number(random), number(random)), half(0.5 + 0.4 * number(random), 0.5 + 0.4 * number(random));
      const Footprint f = with_gradient(i % 5 == 0 ? 0.0 : size * number(random), i % 5 == 1 ? 0.0 : size * number(random));
      const ConvexPolygon p =
          polygon({center - half, {center.x + half.x, center.y - half.y}, center + half, {center.x - half.x, center.y + half.y}});
      const Complex exact = phase_integral(f, 1.0, center, 2.0 * half.x, 2.0 * half.y);
      // 1e-13 of the area; where the integral itself is 1 / size, a phase of `size` rounds by 1e-16 of it.
      EXPECT_NEAR(std::abs(phase_integral(f, 1.0, p) - exact), 0.0, 1e-13 * area(p)) << size;
    }
}

TEST(PolygonIntegral, PartsAddUpWhateverTheGradient) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  ConvexPolygon positive, negative;
  for (const double size : {1e-9, 1e-3, 0.3, 1.0, 10.0, 1e3, 1e6})
    for (int i = 0; i < 100; ++i) {
      const ConvexPolygon p = random_polygon(random, 3 + i % 6);
      const Footprint f = with_gradient(size * number(random), size * number(random));
      cut(p, {0.3 * number(random), number(random), number(random)}, 1e-15, positive, negative);
      Complex sum = positive.empty() ? 0.0 : phase_integral(f, 1.0, positive);
      if (!negative.empty()) sum += phase_integral(f, 1.0, negative);
      EXPECT_NEAR(std::abs(sum - phase_integral(f, 1.0, p)), 0.0, 1e-13) << size;
    }
}

// A needle 1e-9 wide: the error counts against its own area.
TEST(PolygonIntegral, OfANeedleIsAsGoodAsOfAnyOther) {
  const double width = 1e-9;
  const ConvexPolygon needle = polygon({{0, 0}, {1, 0}, {1, width}, {0, width}});
  for (const double size : {1e-3, 1.0, 50.0}) {
    const Complex exact = phase_integral(with_gradient(size, 2.0 * size), 1.0, {0.5, 0.5 * width}, 1.0, width);
    EXPECT_NEAR(std::abs(phase_integral(with_gradient(size, 2.0 * size), 1.0, needle) - exact), 0.0, 1e-13 * width);
  }
}

}  // namespace
}  // namespace raytube
