// Fans of rays against the tracer of single rays.
#include <gtest/gtest.h>

#include <random>

#include "unit/mesh_shapes.h"
#include "utd/fan/ray_fan.h"

namespace raytube {
namespace {

/// Numbers in [-1, 1] and directions, the same in every run.
class Random {
 public:
  double number() { return 2.0 * static_cast<double>(engine_()) / 4294967296.0 - 1.0; }
  dvec3 vector() { return {number(), number(), number()}; }
  dvec3 direction() {
    for (;;) {
      const dvec3 v = vector();
      if (const double size = glm::length(v); size > 0.1 && size < 1.0) return v / size;
    }
  }

 private:
  std::mt19937 engine_{11};
};

PolygonSoup dihedral() {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {0, 1, 0}, {0, 1, 1}}, {{0, 1, 2, 3}, {0, 3, 5, 4}}};
}

PolygonSoup trihedral() { return shapes::joined(dihedral(), shapes::plate({0, 0, 0}, {0, 1, 0}, {1, 0, 0})); }

PolygonSoup cube_beside_plate() {
  return shapes::joined(shapes::box({0.3, -0.2, 0.1}, {0.9, 0.6, 0.7}), shapes::plate({-1, -1, -0.5}, {2, 0, 0}, {0, 2, 0}));
}

/// The hit at a position, if any.
const FanHit* hit_at(const std::vector<FanHit>& hits, double position) {
  for (const FanHit& hit : hits)
    if (hit.from <= position && position <= hit.to) return &hit;
  return nullptr;
}

/// Whether a position is so close to where something begins or ends that one ray of single precision may differ.
bool at_an_end(const std::vector<FanHit>& hits, double position) {
  for (const FanHit& hit : hits)
    if (std::abs(hit.from - position) < 1e-6 || std::abs(hit.to - position) < 1e-6) return true;
  return false;
}

/// What the tracer finds, closed bodies from outside only.
Hit first_hit(const Tracer& tracer, const dvec3& origin, const dvec3& direction, const IgnoredPatches& ignored) {
  const TriangleMesh& mesh = tracer.mesh();
  Ray ray{origin, direction, no_index};
  double gone = 0.0;
  for (int passed = 0; passed < 20; ++passed) {
    Hit hit;
    tracer.closest_hits({&ray, 1}, {&hit, 1});
    if (!hit) return hit;
    const std::uint32_t patch = mesh.triangle_patch[hit.triangle];
    const bool from_inside = mesh.closed(hit.triangle) && glm::dot(mesh.patches[patch].normal, direction) > 0.0;
    gone += hit.distance;
    if (!from_inside && std::ranges::find(ignored, patch) == ignored.end()) return {hit.triangle, gone};
    ray = {ray.origin + hit.distance * direction, direction, patch};
  }
  ADD_FAILURE() << "more surfaces on a ray than there are";
  return {};
}

void expect_single_rays(const PolygonSoup& soup, int fans, bool ignore) {
  const LoadedMesh loaded = shapes::build(soup);
  const TriangleMesh& mesh = loaded.mesh;
  const Tracer tracer(mesh);
  const FaceTree tree(mesh);
  RayFanTracer fan_tracer(tree);
  Random random;
  std::vector<FanHit> hits;
  int found = 0;
  for (int i = 0; i < fans; ++i) {
    const RayFan fan{2.0 * random.vector(), random.direction(), random.direction(), -1.5, 1.5};
    const IgnoredPatches ignored{ignore ? static_cast<std::uint32_t>(i % mesh.patches.size()) : no_index, no_index, no_index};
    fan_tracer.trace(fan, ignored, hits);
    for (const FanHit& hit : hits) EXPECT_LT(hit.from, hit.to);
    for (std::size_t h = 1; h < hits.size(); ++h) EXPECT_LE(hits[h - 1].to, hits[h].from);
    for (int ray = 0; ray < 25; ++ray) {
      const double position = 1.49 * random.number();
      if (at_an_end(hits, position)) continue;
      const FanHit* in_fan = hit_at(hits, position);
      const Hit single = first_hit(tracer, fan.base + position * fan.step, fan.direction, ignored);
      ASSERT_EQ(in_fan != nullptr, bool(single)) << "fan " << i << ", position " << position;
      if (!single) continue;
      ++found;
      const std::uint32_t patch = tree.faces()[in_fan->face].patch;
      EXPECT_EQ(patch, mesh.triangle_patch[single.triangle]) << "fan " << i << ", position " << position;
      // Rounding over the cosine of grazing rays.
      EXPECT_NEAR(in_fan->length + position * in_fan->growth, single.distance, 1e-10);
    }
  }
  EXPECT_GT(found, fans / 4);
}

TEST(RayFan, MeetsWhatItsRaysMeet) {
  for (const bool ignore : {false, true}) {
    expect_single_rays(dihedral(), 200, ignore);
    expect_single_rays(trihedral(), 200, ignore);
    expect_single_rays(cube_beside_plate(), 200, ignore);
    expect_single_rays(shapes::sphere(8), 60, ignore);
    expect_single_rays(shapes::remeshed(trihedral(), 3, 3), 100, ignore);
  }
}

TEST(RayFan, ReflectedRaysGoOnAsSingleOnes) {
  const LoadedMesh loaded = shapes::build(trihedral());
  const FaceTree tree(loaded.mesh);
  RayFanTracer tracer(tree);
  Random random;
  std::vector<FanHit> hits;
  int checked = 0;
  for (int i = 0; i < 100; ++i) {
    const RayFan fan{random.vector(), random.direction(), random.direction(), -1.0, 1.0};
    tracer.trace(fan, {no_index, no_index, no_index}, hits);
    for (const FanHit& hit : hits) {
      const Patch& plane = loaded.mesh.patches[tree.faces()[hit.face].patch];
      const RayFan next = reflected(fan, hit, plane.normal);
      EXPECT_EQ(next.from, hit.from);
      EXPECT_EQ(next.to, hit.to);
      EXPECT_NEAR(glm::dot(next.direction, plane.normal), -glm::dot(fan.direction, plane.normal), 1e-15);
      for (const double position : {hit.from, 0.3 * hit.from + 0.7 * hit.to}) {
        const dvec3 start = next.base + position * next.step;
        // On the plane and on the ray: rounding over the cosine of grazing rays.
        EXPECT_NEAR(glm::dot(start, plane.normal), plane.offset, 1e-12);
        const dvec3 ray = start - fan.base - position * fan.step;
        EXPECT_NEAR(glm::length(glm::cross(ray, fan.direction)), 0.0, 1e-12);
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 50);
}

}  // namespace
}  // namespace raytube
