// Triangles and vertices in another order, facets wound the other way round.
#include <numeric>

#include "mesh/repair/triangulate.h"
#include "stress/description.h"
#include "stress/stability.h"

namespace raytube::testing {
namespace {

// Fisher & Yates.
std::vector<std::uint32_t> random_order(std::size_t count, std::uint64_t stream) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = count; i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(random_number(stream, i) * static_cast<double>(i))]);
  return order;
}

PolygonSoup triangles_of(const PolygonSoup& soup) {
  PolygonSoup result{soup.points, {}};
  for (const auto& polygon : soup.polygons)
    for (const auto& [a, b, c] : triangulate(soup.points, polygon)) result.polygons.push_back({a, b, c});
  return result;
}

PolygonSoup shuffled(const PolygonSoup& soup, std::uint64_t trial) {
  const std::vector<std::uint32_t> points = random_order(soup.points.size(), 100 + 3 * trial);
  const std::vector<std::uint32_t> polygons = random_order(soup.polygons.size(), 101 + 3 * trial);
  PolygonSoup result;
  result.points.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) result.points[points[i]] = soup.points[i];
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    std::vector<std::uint32_t> polygon = soup.polygons[polygons[i]];
    const double turn = random_number(102 + 3 * trial, i) * static_cast<double>(polygon.size());
    std::ranges::rotate(polygon, polygon.begin() + static_cast<std::ptrdiff_t>(turn));
    for (std::uint32_t& corner : polygon) corner = points[corner];
    result.polygons.push_back(std::move(polygon));
  }
  return result;
}

std::vector<NamedSoup> cut(std::vector<NamedSoup> targets) {
  for (NamedSoup& target : targets) target.soup = triangles_of(target.soup);
  return targets;
}

TEST(Order, TrianglesAndVerticesShuffled) {
  const auto changed = [](Description d, int trial) {
    d.soup = shuffled(d.soup, static_cast<std::uint64_t>(trial));
    return Change{std::move(d)};
  };
  expect_unseen("triangles, their first corners and vertices in random order", size_of_run(1, 5), changed, cut);
}

TEST(Order, AllTrianglesTurnedOver) {
  const auto changed = [](Description d, int) {
    for (auto& triangle : d.soup.polygons) std::ranges::reverse(triangle);
    return Change{std::move(d)};
  };
  expect_unseen("all triangles wound the other way", 1, changed, cut);
}

TEST(Order, RandomTrianglesTurnedOver) {
  const auto changed = [](Description d, int trial) {
    for (std::size_t i = 0; i < d.soup.polygons.size(); ++i)
      if (random_number(90 + static_cast<std::uint64_t>(trial), i) < 0.5) std::ranges::reverse(d.soup.polygons[i]);
    return Change{std::move(d)};
  };
  expect_unseen("half of the triangles, drawn at random, wound the other way", size_of_run(1, 5), changed, cut);
}

}  // namespace
}  // namespace raytube::testing
