// The tree leaves nothing out, and little is looked at in it where many long triangles meet.
#include "mesh/model/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "mesh/trace/exact_hit.h"
#include "shapes.h"
#include "unit/uncertain_rays.h"

namespace raytube {
namespace {

TriangleMesh mesh_of(PolygonSoup soup) { return build_mesh(std::move(soup), 1.0).mesh; }

std::uint64_t pairs_looked_at(const TriangleMesh& mesh) {
  return TriangleTree(mesh).close_pairs(2e-6 * mesh.radius, [](std::uint32_t, std::uint32_t) { return true; }).size();
}

std::uint64_t near_coincident_listed(const TriangleMesh& mesh) {
  const NearCoincident near_coincident(mesh, TriangleTree(mesh), 2e-6 * mesh.radius, 0.25);
  std::uint64_t count = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) count += near_coincident[t].size();
  return count;
}

const glm::dmat3 turned(0.6, 0.0, 0.8, 0.0, 1.0, 0.0, -0.8, 0.0, 0.6);

TEST(TriangleTree, FindsAllThatALineMeets) {
  for (const TriangleMesh& mesh :
       {mesh_of(shapes::icosphere(2)), mesh_of(shapes::cone(1.0, 0.7, 300, true)), mesh_of(shapes::sheet_on_plate(12))}) {
    const TriangleTree tree(mesh);
    const ExactHit exact(mesh);
    UncertainRays rays(mesh);
    std::vector<std::uint32_t> found;
    for (int i = 0; i < 500; ++i) {
      const Ray ray = rays.next();
      tree.near_line(ray.origin, ray.direction, found);
      const std::set<std::uint32_t> near(found.begin(), found.end());
      EXPECT_EQ(near.size(), found.size());
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) EXPECT_TRUE(!exact.contains(ray, t) || near.contains(t));
    }
  }
}

TEST(TriangleTree, FindsAllPairsThatCross) {
  const PolygonSoup other = shapes::transformed(shapes::icosphere(2, 0.9), turned, 1.0, {0.2, 0.1, 0.15});
  const TriangleMesh mesh = mesh_of(shapes::joined(shapes::icosphere(2), other));
  std::set<std::pair<std::uint32_t, std::uint32_t>> visited;
  for (const auto& [a, b] : TriangleTree(mesh).close_pairs(1e-6, [](std::uint32_t, std::uint32_t) { return true; }))
    EXPECT_TRUE(visited.insert(std::minmax(a, b)).second);
  // An edge of one that runs through the other.
  const ExactHit exact(mesh);
  int crossing = 0;
  for (std::uint32_t a = 0; a < mesh.triangles.size(); ++a)
    for (int k = 0; k < 3; ++k) {
      const dvec3 from = mesh.vertices[mesh.triangles[a][k]], edge = mesh.vertices[mesh.triangles[a][(k + 1) % 3]] - from;
      const Ray ray{from, glm::normalize(edge), no_index};
      for (std::uint32_t b = 0; b < mesh.triangles.size(); ++b) {
        if (mesh.triangle_component[a] == mesh.triangle_component[b] || !exact.ahead(ray, b) || !exact.contains(ray, b)) continue;
        if (exact.distance(ray, b) > glm::length(edge)) continue;
        EXPECT_TRUE(visited.contains(std::minmax(a, b)));
        ++crossing;
      }
    }
  EXPECT_GT(crossing, 50);
}

// All facets of a cone meet in its tip, all triangles of its bottom in a corner, where facets stand too.
TEST(TriangleTree, WorkGrowsWithTheNumberOfFacetsAtATip) {
  const auto looked_at = [](std::uint32_t sides) {
    return static_cast<double>(pairs_looked_at(mesh_of(shapes::transformed(shapes::cone(1.0, 0.7, sides, true), turned))));
  };
  EXPECT_LT(looked_at(4000), 100.0 * 4000.0);
  EXPECT_LT(looked_at(4000), 2.5 * 2.0 * looked_at(1000));  // four times as many facets: n log n, not n^2
}

TEST(NearCoincident, FacetsRoundATipAreNotOverOneAnother) {
  EXPECT_EQ(near_coincident_listed(mesh_of(shapes::cone(1.0, 0.7, 2000, false))), 0u);
}

// Two triangles with one common corner; the second has its side at `low` to `high` [rad] as that corner sees it, turned up by
// `tilt`.
std::uint64_t listed(double low, double high, double tilt) {
  const auto at = [](double phi, double up) {
    return dvec3(std::cos(phi) * std::cos(up), std::sin(phi) * std::cos(up), std::sin(up));
  };
  PolygonSoup soup{{{0, 0, 0}, at(-0.4, 0.0), at(0.4, 0.0), at(low, tilt), at(high, tilt)}, {{0, 1, 2}, {0, 3, 4}}};
  return near_coincident_listed(mesh_of(std::move(soup)));
}

TEST(NearCoincident, AtACornerOnlyWhatLiesOverATriangleNarrowly) {
  EXPECT_EQ(listed(-0.3, 0.3, 0.05), 2u);    // over it
  EXPECT_EQ(listed(-0.01, 0.01, 0.05), 2u);  // over its middle
  EXPECT_EQ(listed(-0.3, 0.3, 0.5), 0u);     // over it, but wide open
  EXPECT_EQ(listed(0.41, 0.8, 0.0), 0u);     // beside it
  EXPECT_EQ(listed(0.41, 0.8, 0.02), 0u);
  EXPECT_EQ(listed(0.2, 0.8, 0.02), 2u);   // half over it
  EXPECT_EQ(listed(-0.8, 0.8, 0.08), 2u);  // over all of it and more
}

}  // namespace
}  // namespace raytube
