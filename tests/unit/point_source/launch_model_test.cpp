// The six launch models: counts, directions, weights.
#include <gmock/gmock.h>

#include "core/error.h"
#include "shapes.h"
#include "source_scene.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const SourceScene& room() {
  static const SourceScene scene({shapes::box({4, 6, 2})});
  return scene;
}
const dvec3 source(0.5, -1.0, 0.3);

TEST(LaunchModel, RaysOfEachPattern) {
  const LaunchSite site = room().site(source);
  const auto rays = [&](LaunchModel model, std::uint64_t asked) { return Launch(model, site, asked, 1).rays(); };
  EXPECT_EQ(rays(LaunchModel::random, 2000), 2000u);
  EXPECT_EQ(rays(LaunchModel::angles, 2000), 2u * 32 * 32);
  // 8 x 4^n, the nearest.
  EXPECT_EQ(rays(LaunchModel::octahedron, 2000), 2048u);
  EXPECT_EQ(rays(LaunchModel::octahedron, 10000), 8192u);
  EXPECT_EQ(rays(LaunchModel::octahedron, 1), 8u);
  // 12 triangles of m^2 points; at least one each.
  EXPECT_EQ(rays(LaunchModel::geometry, 1200), 1200u);
  EXPECT_EQ(rays(LaunchModel::geometry, 2000), 12u * 13 * 13);
  EXPECT_EQ(rays(LaunchModel::geometry, 1), 12u);
  // Cells of nearly one size on walls of 88 m^2 in all, or on one of 12 m^2.
  EXPECT_NEAR(static_cast<double>(rays(LaunchModel::box_grid, 100000)), 100000.0, 1000.0);
  EXPECT_NEAR(static_cast<double>(rays(LaunchModel::plane_wave, 100000)), 100000.0, 1000.0);
}

TEST(LaunchModel, RaysLeaveTheSourceThroughTheirPoints) {
  const LaunchSite site = room().site(source);
  for (const LaunchModel model : all_models) {
    if (model == LaunchModel::plane_wave) continue;
    const Launch launch(model, site, 500, 1);
    for (std::uint64_t i = 0; i < launch.rays(); ++i) {
      const LaunchedRay ray = launch.ray(i);
      EXPECT_EQ(ray.ray.origin, site.source);
      EXPECT_NEAR(glm::length(ray.ray.direction - glm::normalize(ray.through - site.source)), 0.0, 1e-15);
    }
  }
}

TEST(LaunchModel, PlaneWaveStartsOnItsWallAndCrossesTheBox) {
  LaunchSite site = room().site(source);
  const dvec3 directions[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (site.wall = 0; site.wall < 6; ++site.wall) {
    const LaunchedRay ray = Launch(LaunchModel::plane_wave, site, 100, 1).ray(7);
    EXPECT_EQ(ray.ray.direction, directions[site.wall]);
    const int axis = site.wall / 2;
    const double wall = site.wall % 2 == 0 ? site.box.low[axis] : site.box.high[axis];
    EXPECT_NEAR(ray.ray.origin[axis], wall, 1e-4);  // a hundred-thousandth of the diagonal inside
  }
}

// The cells of a regular pattern tile the sphere; so do the triangles of a closed room, each seen from inside.
TEST(LaunchModel, WeightsOfAPatternAddUpToTheSphere) {
  for (const LaunchModel model : {LaunchModel::angles, LaunchModel::octahedron, LaunchModel::box_grid, LaunchModel::geometry}) {
    const Launch launch(model, room().site(source), 5000, 1);
    double sum = 0.0;
    for (std::uint64_t i = 0; i < launch.rays(); ++i) sum += launch.weight(launch.ray(i));
    EXPECT_NEAR(sum, 1.0, 1e-11) << launch_model_name(model);  // thousands of terms of rounding 1e-16
  }
}

TEST(LaunchModel, WeightsOfRandomRaysAddUpToTheSphereOnAverage) {
  const Launch launch(LaunchModel::random, room().site(source), 100000, 1);
  const double rays = static_cast<double>(launch.rays());
  double sum = 0.0, squares = 0.0;
  for (std::uint64_t i = 0; i < launch.rays(); ++i) {
    const double weight = launch.weight(launch.ray(i));
    sum += weight;
    squares += weight * weight;
  }
  EXPECT_NEAR(sum, 1.0, 4.0 * std::sqrt(squares - sum * sum / rays));  // four standard deviations, from the sample
}

TEST(LaunchModel, ASeedGivesItsOwnRaysAndAlwaysTheSame) {
  const LaunchSite site = room().site(source);
  const Launch first(LaunchModel::random, site, 100, 1), again(LaunchModel::random, site, 100, 1),
      other(LaunchModel::random, site, 100, 2);
  for (std::uint64_t i = 0; i < 100; ++i) {
    EXPECT_EQ(first.ray(i).through, again.ray(i).through);
    EXPECT_NE(first.ray(i).through, other.ray(i).through);
  }
}

TEST(LaunchModel, PointsOfTheBoxNeedTheSourceInside) {
  for (const LaunchModel model : {LaunchModel::random, LaunchModel::box_grid})
    for (const dvec3& outside : {dvec3(2, 0, 0), dvec3(0, 0, -3)}) try {
        Launch(model, room().site(outside), 100, 1);
        FAIL() << launch_model_name(model);
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("lies on the enclosing box or outside it"));
      }
  EXPECT_EQ(Launch(LaunchModel::octahedron, room().site({0, 0, -3}), 8, 1).rays(), 8u);
}

TEST(LaunchModel, APlaneWaveNeedsAWallWithAnArea) {
  const SourceScene flat({plate_across_x(0, {0, 0}, {1, 1})});
  LaunchSite site = flat.site({0.5, 0.5, 0.5});
  EXPECT_EQ(Launch(LaunchModel::plane_wave, site, 100, 1).rays(), 100u);  // from the wall -x, which is the plate
  site.wall = 2;
  try {
    Launch(LaunchModel::plane_wave, site, 100, 1);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the enclosing box is flat"));
  }
}

}  // namespace
}  // namespace raytube
