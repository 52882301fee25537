// Every hit is the one that double precision finds by trying all triangles, with any packet and under any instruction set.
#include <gtest/gtest.h>

#include <random>

#include "instruction_set.h"
#include "mesh/exact_hit.h"
#include "shapes.h"

namespace raytube {
namespace {

// The nearest triangle that contains the ray, among all of them.
std::uint32_t by_trying_all(const TriangleMesh& mesh, const ExactHit& exact, const Ray& ray) {
  Hit best;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (exact.patch(t) == ray.source_patch || !exact.ahead(ray, t) || !exact.contains(ray, t)) continue;
    if (const double distance = exact.distance(ray, t); !best || distance < best.distance) best = {t, distance};
  }
  return best ? exact.front_of(ray, best, nothing_ignored).triangle : no_index;
}

// Rays that single precision is likely to mistake: through points beside edges by 1e-16 to 1e-5 of the radius, many of them
// almost in the plane of a triangle there.
class DoubtfulRays {
 public:
  explicit DoubtfulRays(const TriangleMesh& mesh) : mesh_(mesh) {}

  Ray next() {
    const auto& corners = mesh_.triangles[pick(mesh_.triangles.size())];
    const std::uint32_t side = pick(3);
    const dvec3 from = mesh_.vertices[corners[side]], to = mesh_.vertices[corners[(side + 1) % 3]];
    const dvec3 point = from + uniform() * (to - from) + small() * mesh_.radius * direction();
    dvec3 along = direction();
    const dvec3 normal = glm::normalize(glm::cross(to - from, mesh_.vertices[corners[(side + 2) % 3]] - from));
    if (pick(2)) along = glm::normalize(along - glm::dot(along, normal) * normal + 100.0 * small() * normal);
    if (glm::length(glm::cross(along, glm::normalize(to - from))) < 0.01) return next();
    return {point - (0.5 + 2.0 * uniform()) * mesh_.radius * along, along, no_index};
  }

 private:
  std::uint32_t pick(std::size_t count) { return static_cast<std::uint32_t>(generator_() % count); }
  double uniform() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }
  double small() { return std::pow(10.0, -5.0 - 11.0 * uniform()) * (pick(2) ? 1.0 : -1.0); }
  dvec3 direction() {
    const double z = 2.0 * uniform() - 1.0, phi = 2.0 * pi * uniform(), s = std::sqrt(1.0 - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
  }

  const TriangleMesh& mesh_;
  std::mt19937_64 generator_{7};
};

void expect_exact(const TriangleMesh& mesh, const std::vector<Ray>& all) {
  const ExactHit exact(mesh);
  std::vector<std::uint32_t> expected;
  for (const Ray& ray : all) expected.push_back(by_trying_all(mesh, exact, ray));
  for (const char* set : {"sse2", "avx2", "avx512"}) {
    if (std::string(set) == "avx512" && widest_instruction_set() != InstructionSet::avx512) continue;
    limit_instruction_set(set);
    for (const int packet : {1, 16}) {
      const Tracer tracer(mesh, packet);
      std::vector<std::uint32_t> found(all.size());
      tracer.closest_triangles(all, found);
      int wrong = 0;
      for (std::size_t i = 0; i < all.size(); ++i) wrong += found[i] != expected[i] ? 1 : 0;
      EXPECT_EQ(wrong, 0) << "of " << all.size() << " rays, " << set << ", packets of " << packet;
    }
  }
  limit_instruction_set(name_of(widest_instruction_set()));
}

PolygonSoup both(PolygonSoup a, const PolygonSoup& b) {
  const auto first = static_cast<std::uint32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (auto polygon : b.polygons) {
    for (auto& corner : polygon) corner += first;
    a.polygons.push_back(polygon);
  }
  return a;
}

void expect_exact(const PolygonSoup& soup, int rays) {
  const TriangleMesh mesh = build_mesh(PolygonSoup(soup), 1.0).mesh;
  std::vector<Ray> all;
  DoubtfulRays doubtful(mesh);
  for (int i = 0; i < rays; ++i) all.push_back(doubtful.next());
  expect_exact(mesh, all);
}

TEST(ExactHits, Plate) { expect_exact(shapes::plate(1.0, 0.3), 4000); }
TEST(ExactHits, Cube) { expect_exact(shapes::cube(1.0), 4000); }
TEST(ExactHits, Dihedral) { expect_exact(shapes::dihedral(1.0, 1.3), 4000); }
TEST(ExactHits, Sphere) { expect_exact(shapes::icosphere(3), 4000); }
TEST(ExactHits, Cylinder) { expect_exact(shapes::cylinder(0.3, 1.0, 90), 4000); }
// A facet grazed at a sine of 1e-7 has no place along the ray in single precision, and something else may stand in front of it.
TEST(ExactHits, GrazedFacetsAmongOthers) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto place = [&] { return dvec3(uniform(generator), uniform(generator), uniform(generator)); };
  PolygonSoup soup;
  for (std::uint32_t t = 0; t < 300; ++t) {
    const dvec3 middle = place();
    for (int k = 0; k < 3; ++k) soup.points.push_back(middle + 0.3 * place());
    soup.polygons.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const TriangleMesh mesh = build_mesh(std::move(soup), 1.0).mesh;
  std::vector<Ray> rays;
  while (rays.size() < 4000) {
    const auto& [a, b, c] = mesh.triangles[generator() % mesh.triangles.size()];
    const dvec3 side = glm::normalize(mesh.vertices[b] - mesh.vertices[a]), other = mesh.vertices[c] - mesh.vertices[a];
    const dvec3 normal = glm::normalize(glm::cross(side, other));
    const double azimuth = pi * uniform(generator), sine = std::pow(10.0, -5.0 - 2.0 * std::abs(uniform(generator)));
    const dvec3 along = glm::normalize(std::cos(azimuth) * side + std::sin(azimuth) * glm::cross(normal, side) + sine * normal);
    rays.push_back({(mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0 - 4.0 * along, along, no_index});
  }
  expect_exact(mesh, rays);
}
TEST(ExactHits, CrossingPlates) {
  const auto tilted = shapes::transformed(shapes::plate(1.0, 0.1), glm::dmat3(0.6, 0.0, 0.8, 0.0, 1.0, 0.0, -0.8, 0.0, 0.6));
  expect_exact(both(shapes::plate(1.0), tilted), 4000);
}

}  // namespace
}  // namespace raytube
