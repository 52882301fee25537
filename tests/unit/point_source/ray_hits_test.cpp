// Rays bouncing through scenes of named parts: counts known by hand, and that nothing is lost.
#include <gtest/gtest.h>

#include "shapes.h"
#include "source_scene.h"

namespace raytube {
namespace {

using namespace raytube::testing;

TEST(JoinedMesh, EveryTriangleKnowsItsPart) {
  // The second part lies on the first: neither is welded nor dropped.
  const SourceScene scene({shapes::cube(1.0), moved(shapes::cube(1.0), {1, 0, 0}), plate_across_x(5, {0, 0}, {1, 1})});
  const TriangleMesh& mesh = scene.joined.mesh;
  ASSERT_EQ(mesh.triangles.size(), 26u);
  ASSERT_EQ(mesh.patches.size(), 13u);
  EXPECT_EQ(mesh.components.size(), 3u);
  for (std::uint32_t t = 0; t < 26; ++t) {
    const std::uint32_t part = t < 12 ? 0 : t < 24 ? 1 : 2;
    EXPECT_EQ(scene.joined.triangle_part[t], part);
    const double low = part == 0 ? -0.5 : part == 1 ? 0.5 : 5.0, high = part == 2 ? 5.0 : low + 1.0;
    const Patch& plane = mesh.patch_of(t);
    for (const std::uint32_t v : mesh.triangles[t]) {
      const dvec3 at = mesh.vertices[v] + mesh.center;
      EXPECT_GE(at.x, low - 1e-12);
      EXPECT_LE(at.x, high + 1e-12);
      EXPECT_NEAR(glm::dot(plane.normal, mesh.vertices[v]), plane.offset, 1e-12);
    }
  }
}

TEST(RayHits, ParallelPlatesHandThePlaneWaveOnUntilItIsCut) {
  // Mirrors x = 0 and x = 1: the wave starts just inside the first one and goes back and forth for ever.
  const SourceScene scene({plate_across_x(0, {-1, -1}, {1, 1}), plate_across_x(1, {-1, -1}, {1, 1})});
  const Launch launch = scene.launch(LaunchModel::plane_wave, scene.site({0.5, 0, 0}), 400);
  for (const int reflections : {0, 1, 6, 7}) {
    const RayHits hits = scene.trace(launch, reflections);
    // x = 1, x = 0, x = 1 ... reflections + 1 hits in all.
    EXPECT_EQ(hits.parts[1].first_hits, launch.rays());
    EXPECT_EQ(hits.parts[1].all_hits, launch.rays() * (reflections / 2 + 1));
    EXPECT_EQ(hits.parts[0].all_hits, launch.rays() * ((reflections + 1) / 2));
    EXPECT_EQ(hits.cut, launch.rays());
    EXPECT_EQ(hits.escaped + hits.absorbed, 0u);
  }
}

TEST(RayHits, AnAbsorberEndsEveryRay) {
  const SourceScene scene({plate_across_x(0, {-1, -1}, {1, 1}), plate_across_x(1, {-1, -1}, {1, 1})},
                          {RaySurface::absorber, RaySurface::pec});
  const Launch launch = scene.launch(LaunchModel::plane_wave, scene.site({0.5, 0, 0}), 400);
  const RayHits hits = scene.trace(launch);
  EXPECT_EQ(hits.parts[1].all_hits, launch.rays());
  EXPECT_EQ(hits.parts[0].all_hits, launch.rays());
  EXPECT_EQ(hits.absorbed, launch.rays());
  ASSERT_EQ(hits.hits.size(), launch.rays());  // kept: those on part 0, after one bounce
  for (const CountedHit& hit : hits.hits) EXPECT_EQ(hit.bounce, 1u);
}

TEST(RayHits, ReflectionIsSpecular) {
  // A wave along +x on a plate tilted by 45 degrees goes on along +z, to the lid.
  const PolygonSoup reflector{{{0, -1, 0}, {1, -1, 1}, {1, 1, 1}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const PolygonSoup lid{{{0, -1, 3}, {1, -1, 3}, {1, 1, 3}, {0, 1, 3}}, {{0, 1, 2}, {0, 2, 3}}};
  const SourceScene scene({lid, reflector}, {RaySurface::absorber, RaySurface::pec});
  const Launch launch = scene.launch(LaunchModel::plane_wave, scene.site({0.5, 0, 2}), 3000);
  const RayHits hits = scene.trace(launch);
  EXPECT_EQ(hits.parts[0].all_hits, hits.parts[1].first_hits);
  // The lower third of the wall, 2 m x 3 m, sends its rays into the reflector, the rest escape over it: to one row of 2
  // sqrt(500).
  EXPECT_NEAR(static_cast<double>(hits.parts[1].first_hits), static_cast<double>(launch.rays()) / 3.0, 45.0);
  EXPECT_EQ(hits.missed, launch.rays() - hits.parts[1].first_hits);
}

// A scene with all there is: closed and open parts, reflectors and absorbers, gaps to escape through.
const SourceScene& mixed_scene() {
  static const SourceScene scene(
      {moved(shapes::icosphere(2, 0.4), {1, 1, 0}), shapes::trihedral(3.0), plate_across_x(2.5, {-1, -2}, {1, 2})},
      {RaySurface::pec, RaySurface::pec, RaySurface::absorber});
  return scene;
}
const dvec3 mixed_source(2.0, 0.6, 0.7);

TEST(RayHits, EveryRayIsAccountedFor) {
  for (const LaunchModel model : all_models) {
    const Launch launch = mixed_scene().launch(model, mixed_scene().site(mixed_source), 20000);
    const RayHits hits = mixed_scene().trace(launch, 3);
    EXPECT_EQ(hits.escaped + hits.absorbed + hits.cut, launch.rays()) << launch_model_name(model);
    EXPECT_EQ(hits.parts[0].first_hits + hits.parts[1].first_hits + hits.parts[2].first_hits + hits.missed, launch.rays());
    EXPECT_EQ(hits.hits.size(), hits.parts[0].all_hits);
    EXPECT_EQ(hits.absorbed, hits.parts[2].all_hits);
  }
}

TEST(RayHits, WithoutReflectionsTheResponseIsTheDirectEstimate) {
  const Launch launch = mixed_scene().launch(LaunchModel::geometry, mixed_scene().site(mixed_source), 20000);
  const RayHits direct = mixed_scene().trace(launch, 0), reflected = mixed_scene().trace(launch, 5);
  EXPECT_DOUBLE_EQ(direct.parts[0].response, direct.parts[0].estimate);  // the same sum, in another order
  EXPECT_EQ(reflected.parts[0].estimate, direct.parts[0].estimate);
  EXPECT_GT(reflected.parts[0].response, direct.parts[0].response);
}

}  // namespace
}  // namespace raytube
