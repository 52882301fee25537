// Rays of every launch model: the same counts, sums and hits for any number of threads.
#include <gtest/gtest.h>

#include <cstring>

#include "shapes.h"
#include "source_scene.h"

namespace raytube {
namespace {

using namespace raytube::testing;

TEST(Sources, SameBitsForAnyThreads) {
  const SourceScene scene(
      {moved(shapes::icosphere(2, 0.4), {1, 1, 0}), shapes::trihedral(3.0), plate_across_x(2.5, {-1, -2}, {1, 2})},
      {RaySurface::pec, RaySurface::pec, RaySurface::absorber});
  for (const LaunchModel model : all_models) {
    const Launch launch = scene.launch(model, scene.site({2.0, 0.6, 0.7}), 30000);
    const RayHits one = scene.trace(launch, 5, 0, 1);
    EXPECT_GT(one.parts[0].all_hits, 0u) << launch_model_name(model);
    for (const int threads : {2, 3, 7}) {
      const RayHits many = scene.trace(launch, 5, 0, threads);
      EXPECT_EQ(std::memcmp(one.parts.data(), many.parts.data(), one.parts.size() * sizeof(PartHits)), 0)
          << launch_model_name(model);
      ASSERT_EQ(one.hits.size(), many.hits.size());
      for (std::size_t i = 0; i < one.hits.size(); ++i) {
        EXPECT_EQ(one.hits[i].point, many.hits[i].point);
        EXPECT_EQ(one.hits[i].bounce, many.hits[i].bounce);
      }
    }
  }
}

}  // namespace
}  // namespace raytube
