// Every hit is the one that double precision finds by trying all triangles, with any packet and under any instruction set.
#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <random>

#include "core/instruction_set.h"
#include "mesh/trace/exact_hit.h"
#include "shapes.h"
#include "unit/uncertain_rays.h"

namespace raytube {
namespace {

// The nearest triangle that contains the ray, among all of them.
std::uint32_t by_trying_all(const TriangleMesh& mesh, const ExactHit& exact, const Ray& ray) {
  Hit best;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (exact.patch(t) == ray.source_patch || !exact.ahead(ray, t) || !exact.contains(ray, t)) continue;
    const double depth = exact.depth(ray, t);
    if (depth >= -exact.edge_uncertainty() && (!best || depth < best.distance)) best = {t, depth};
  }
  return best ? exact.front_of(ray, best, nothing_ignored).triangle : no_index;
}

void expect_exact(const TriangleMesh& mesh, const std::vector<Ray>& all) {
  const ExactHit exact(mesh);
  std::vector<std::uint32_t> expected;
  for (const Ray& ray : all) expected.push_back(by_trying_all(mesh, exact, ray));
  for (const char* set : {"sse2", "avx2", "avx512"}) {
    if (std::string(set) == "avx512" && widest_instruction_set() != InstructionSet::avx512) continue;
    limit_instruction_set(set);
    for (const int packet : {1, 16}) {
      const Tracer tracer(mesh, packet);
      std::vector<Hit> found(all.size());
      std::vector<std::uint32_t> any(all.size());
      tracer.closest_hits(all, found);
      tracer.any_blockers(all, nothing_ignored, any);
      int wrong = 0, wrongly_blocked = 0;
      for (std::size_t i = 0; i < all.size(); ++i) wrong += found[i].triangle != expected[i] ? 1 : 0;
      for (std::size_t i = 0; i < all.size(); ++i) {
        const bool right = any[i] == no_index ? expected[i] == no_index : exact.meets(all[i], any[i], nothing_ignored);
        wrongly_blocked += right ? 0 : 1;
      }
      EXPECT_EQ(wrong, 0) << "of " << all.size() << " rays, " << set << ", packets of " << packet;
      EXPECT_EQ(wrongly_blocked, 0) << "of " << all.size() << " rays, " << set << ", packets of " << packet;
    }
  }
  limit_instruction_set(name_of(widest_instruction_set()));
}

void expect_exact(const PolygonSoup& soup, int rays) {
  const TriangleMesh mesh = build_mesh(PolygonSoup(soup), 1.0).mesh;
  std::vector<Ray> all;
  UncertainRays uncertain(mesh);
  for (int i = 0; i < rays; ++i) all.push_back(uncertain.next());
  expect_exact(mesh, all);
}

TEST(ExactHits, Plate) { expect_exact(shapes::plate(1.0, 0.3), 4000); }
TEST(ExactHits, Cube) { expect_exact(shapes::cube(1.0), 4000); }
TEST(ExactHits, Dihedral) { expect_exact(shapes::dihedral(1.0, 1.3), 4000); }
TEST(ExactHits, Sphere) { expect_exact(shapes::icosphere(3), 4000); }
TEST(ExactHits, Cylinder) { expect_exact(shapes::cylinder(0.3, 1.0, 90), 4000); }
TEST(ExactHits, Cone) { expect_exact(shapes::cone(1.0, 0.7, 300, true), 4000); }
TEST(ExactHits, FineSheetOnAPlate) { expect_exact(shapes::sheet_on_plate(12), 4000); }
// Long lists are left to a tree: the same decisions, whatever is called long.
TEST(ExactHits, LengthOfListsIsNothingButSpeed) {
  for (const PolygonSoup& soup : {shapes::cone(1.0, 0.7, 300, true), shapes::sheet_on_plate(12), shapes::icosphere(2)}) {
    const TriangleMesh mesh = build_mesh(PolygonSoup(soup), 1.0).mesh;
    const ExactHit never(mesh, mesh.triangles.size()), seldom(mesh, 64), always(mesh, 0);
    const auto expect_same = [&](auto query) {
      const Hit expected = query(never);
      for (const ExactHit* exact : {&seldom, &always}) {
        EXPECT_EQ(query(*exact).triangle, expected.triangle);
        EXPECT_EQ(query(*exact).distance, expected.distance);
      }
    };
    UncertainRays rays(mesh);
    for (int i = 0; i < 300; ++i) {
      const Ray ray = rays.next();
      for (std::uint32_t t = static_cast<std::uint32_t>(i) % 7; t < mesh.triangles.size(); t += 7) {
        expect_same([&](const ExactHit& exact) { return exact.nearest_near_coincident(ray, t, nothing_ignored); });
        expect_same([&](const ExactHit& exact) { return exact.nearest_around(ray, t, nothing_ignored); });
        const Hit hit{t, never.distance(ray, t)};
        expect_same([&](const ExactHit& exact) { return exact.front_of(ray, hit, nothing_ignored); });
      }
    }
  }
}
// Rays from afar through middles of facets, almost in their planes.
std::vector<Ray> grazing_rays(const TriangleMesh& mesh, double largest_sine) {
  std::mt19937_64 generator(12);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Ray> rays;
  while (rays.size() < 4000) {
    const auto& [a, b, c] = mesh.triangles[generator() % mesh.triangles.size()];
    const dvec3 side = glm::normalize(mesh.vertices[b] - mesh.vertices[a]), other = mesh.vertices[c] - mesh.vertices[a];
    const dvec3 normal = glm::normalize(glm::cross(side, other));
    const double azimuth = pi * uniform(generator), sine = largest_sine * std::pow(10.0, -2.0 * std::abs(uniform(generator)));
    const dvec3 along = glm::normalize(std::cos(azimuth) * side + std::sin(azimuth) * glm::cross(normal, side) + sine * normal);
    rays.push_back({(mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0 - 4.0 * along, along, no_index});
  }
  return rays;
}
// A facet grazed at a sine of 1e-7 has no depth along the ray in single precision, and something else may stand in front of it.
TEST(ExactHits, GrazedFacetsAmongOthers) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto point = [&] { return dvec3(uniform(generator), uniform(generator), uniform(generator)); };
  PolygonSoup soup;
  for (std::uint32_t t = 0; t < 300; ++t) {
    const dvec3 middle = point();
    for (int k = 0; k < 3; ++k) soup.points.push_back(middle + 0.3 * point());
    soup.polygons.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const TriangleMesh mesh = build_mesh(std::move(soup), 1.0).mesh;
  expect_exact(mesh, grazing_rays(mesh, 1e-5));
}
// Such a ray meets the plane of a patch that is flat but for roundings of a file's coordinates far from where it meets the facet.
TEST(ExactHits, GrazedFacetsOfPatchesThatAreNotQuiteFlat) {
  std::mt19937_64 generator(13);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto point = [&] { return dvec3(uniform(generator), uniform(generator), uniform(generator)); };
  PolygonSoup soup;
  for (std::uint32_t plate = 0; plate < 40; ++plate) {
    const dvec3 middle = point(), u = 0.3 * point(), v = 0.3 * point();
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (int i = 0; i < 9; ++i) soup.points.push_back(middle + (i / 3 - 1.0) * u + (i % 3 - 1.0) * v + 2e-7 * point());
    for (const std::uint32_t p : {0u, 1u, 3u, 4u}) {
      soup.polygons.push_back({first + p, first + p + 1, first + p + 4});
      soup.polygons.push_back({first + p, first + p + 4, first + p + 3});
    }
  }
  const TriangleMesh mesh = build_mesh(std::move(soup), 1.0).mesh;
  ASSERT_LT(mesh.patches.size(), 60u);
  for (const double largest_sine : {1e-5, 1e-7}) expect_exact(mesh, grazing_rays(mesh, largest_sine));
}
// A steep wall crosses a floor of many triangles beside a line of their edges: a ray that runs along the floor meets it in a
// triangle that does not touch the wall, and in single precision at the same depth.
TEST(ExactHits, FloorOfManyTrianglesBeforeAWall) {
  constexpr int n = 20;
  for (const double beyond_line : {4e-6, 1.2e-5, 3e-5}) {
    PolygonSoup scene = shapes::joined(
        shapes::tiled_plate(2.0, n),
        {{{beyond_line, -0.91, -0.5}, {beyond_line, 0.87, -0.5}, {beyond_line, 0.87, 0.5}, {beyond_line, -0.91, 0.5}},
         {{0, 1, 2, 3}}});
    const glm::dmat3 turn = glm::mat3_cast(glm::angleAxis(0.7, glm::normalize(dvec3(0.3, -0.2, 1.0))));
    const TriangleMesh mesh = build_mesh(shapes::transformed(scene, turn), 1.0).mesh;
    std::mt19937_64 generator(3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<Ray> rays;
    for (const double sine : {1e-5, 1e-4, 3e-4, 2e-3, 5e-3, 2e-2, 0.1})
      for (int i = 0; i < 400; ++i) {
        const dvec3 point(-1.5e-5 - (i % 2 ? 0.1 : 3.0) * beyond_line * uniform(generator), 1.6 * uniform(generator) - 0.8, 0.0);
        const double azimuth = 0.6 * (uniform(generator) - 0.5) + (i % 4 > 1 ? pi : 0.0), level = std::sqrt(1.0 - sine * sine);
        const dvec3 direction = turn * dvec3(level * std::cos(azimuth), level * std::sin(azimuth), -sine);
        rays.push_back({turn * point - mesh.center - (3.0 * mesh.radius) * direction, direction, no_index});
      }
    expect_exact(mesh, rays);
  }
}

TEST(ExactHits, CrossingPlates) {
  const auto tilted = shapes::transformed(shapes::plate(1.0, 0.1), glm::dmat3(0.6, 0.0, 0.8, 0.0, 1.0, 0.0, -0.8, 0.0, 0.6));
  expect_exact(shapes::joined(shapes::plate(1.0), tilted), 4000);
}

// What is there is rounding, but some triangle or none; then on from where it was met.
TEST(ExactHits, StartOnTheBorderOfAFanOfTriangles) {
  constexpr std::uint32_t corners = 24;
  PolygonSoup soup;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double turn = 2 * pi * i / corners;
    soup.points.push_back(0.25 * dvec3(std::cos(turn) * (1 + 0.3 * std::sin(2.3 * i)), std::sin(turn), 0.0));
  }
  for (std::uint32_t i = 2; i < corners; ++i) soup.polygons.push_back({0, i - 1, i});
  const TriangleMesh mesh = build_mesh(std::move(soup), 1.0).mesh;
  const Tracer tracer(mesh);
  const dvec3 direction = spherical_basis({61 * degree, 17 * degree}).radial;
  for (std::uint32_t i = 0; i < corners; ++i)
    for (int step = 0; step <= 8; ++step) {
      const double share = std::clamp(step / 8.0, 1e-6, 1.0 - 1e-6);
      Ray ray{glm::mix(mesh.vertices[i], mesh.vertices[(i + 1) % corners], share), direction, no_index};
      for (int times = 0; times < 3; ++times) {
        Hit hit;
        tracer.closest_hits({&ray, 1}, {&hit, 1});
        if (!hit) break;
        ASSERT_LT(hit.triangle, mesh.triangles.size());
        ray = {ray.origin + hit.distance * direction, direction, mesh.triangle_patch[hit.triangle]};
      }
    }
}

}  // namespace
}  // namespace raytube
