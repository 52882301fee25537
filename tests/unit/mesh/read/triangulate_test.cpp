// Polygons -> triangles, against cutting ears by trying all corners of all places.
#include "mesh/repair/triangulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/field.h"

namespace raytube {
namespace {

bool is_ear(const PlanarRing& plane, const Ring& ring, std::size_t i) {
  const Triangle ear{ring[(i + ring.size() - 1) % ring.size()], ring[i], ring[(i + 1) % ring.size()]};
  if (!(plane.turn(ear[0], ear[1], ear[2]) > 0.0)) return false;
  return std::ranges::none_of(ring, [&](auto p) { return std::ranges::find(ear, p) == ear.end() && plane.holds(ear, p); });
}

std::vector<Triangle> by_trying_all(const PlanarRing& plane, Ring ring) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; ring.size() > 3;) {
    std::size_t tried = 0;
    while (tried < ring.size() && !is_ear(plane, ring, (i + tried) % ring.size())) ++tried;
    i = (i + tried) % ring.size();
    triangles.push_back({ring[(i + ring.size() - 1) % ring.size()], ring[i], ring[(i + 1) % ring.size()]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
    i = (i + 1) % ring.size();
  }
  triangles.push_back({ring[0], ring[1], ring[2]});
  return triangles;
}

void expect_same(const std::vector<dvec3>& points, const Ring& ring) {
  const PlanarRing plane(points, ring);
  EXPECT_EQ(cut_ears(plane, ring), by_trying_all(plane, ring)) << ring.size() << " corners";
}

Ring all_of(const std::vector<dvec3>& points) {
  Ring ring(points.size());
  for (std::uint32_t i = 0; i < ring.size(); ++i) ring[i] = i;
  return ring;
}

class Ears : public testing::Test {
 protected:
  double uniform() { return std::uniform_real_distribution<double>(-1.0, 1.0)(generator_); }
  std::mt19937_64 generator_{5};
};

TEST_F(Ears, OfStars) {
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<dvec3> points;
    const int size = 4 + 7 * trial;
    for (int i = 0; i < size; ++i) {
      const double radius = 1.0 + 0.9 * uniform(), phi = 2.0 * pi * i / size;
      points.push_back(radius * dvec3(std::cos(phi), std::sin(phi), 0.3 * std::cos(phi)));
    }
    expect_same(points, all_of(points));
  }
}

// Hardly an ear at a time.
TEST_F(Ears, OfASpiral) {
  std::vector<dvec3> points;
  for (const double width : {1.0, 1.3})
    for (int i = 0; i < 120; ++i) {
      const double phi = 0.2 * (width == 1.0 ? i : 119 - i);
      points.push_back(width * std::exp(0.1 * phi) * dvec3(std::cos(phi), std::sin(phi), 0.0));
    }
  expect_same(points, all_of(points));
}

// Rings that cross themselves run out of ears; corners on a grid lie on one another's sides and on one another.
TEST_F(Ears, OfTangles) {
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<dvec3> points;
    for (int i = 0; i < 5 + 3 * trial; ++i)
      points.push_back(trial % 2 ? dvec3(uniform(), uniform(), 0.0)
                                 : dvec3(std::round(5.0 * uniform()), std::round(5.0 * uniform()), 0.0));
    expect_same(points, all_of(points));
  }
}

// A square with a square hole and a bridge that the ring passes twice.
TEST_F(Ears, OfARingWithABridge) {
  const std::vector<dvec3> points{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}};
  expect_same(points, {0, 1, 2, 3, 0, 4, 5, 6, 7, 4});
}

}  // namespace
}  // namespace raytube
