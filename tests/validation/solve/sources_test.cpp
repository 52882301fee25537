// The double slit: what each launch model counts against its exact limit, and against the exact solid angle.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "mesh/load.h"
#include "point_source/source_case.h"
#include "source_scene.h"

namespace raytube {
namespace {

using namespace raytube::testing;

enum Part { room, ground, wall, lintel, screen };

const SourceCase& double_slit_case() {
  static const SourceCase c = read_source_case(RAYTUBE_SOURCE_DIR "/cases/double_slit/case.toml");
  return c;
}

const SourceScene& double_slit() {
  static const SourceScene scene = [] {
    std::vector<PolygonSoup> soups;
    std::vector<RaySurface> surfaces;
    for (const ScenePart& part : double_slit_case().parts) {
      soups.push_back(read_polygon_soup(part.mesh_file));
      surfaces.push_back(part.surface);
    }
    return SourceScene(soups, surfaces);
  }();
  return scene;
}

LaunchSite site() { return double_slit().site(double_slit_case().points[0]); }

TEST(DoubleSlit, HasTheTrianglesOfThePaper) { EXPECT_EQ(double_slit().joined.mesh.triangles.size(), 72u); }

// The wall of 0.06 m slits is 0.01 m thick, so a slit 0.47 to 0.53 m aside lets pass what clears its near front and its far back
// edge: y from 0.47 / 3 to 0.53 / 3.01 of the distance. Seen through it from 1.2 m above the floor, the screen 5 m away reaches
// from 0.8 m below the source to 1.8 m above, and the lintel, at 3 m, ends 1.3 m above it: beyond the top of the screen.
TEST(DoubleSlit, ExactShareAgainstTheRectanglesOfDirections) {
  const double near_edge = 0.47 / 3.0, far_edge = 0.53 / 3.01, down = 0.8 / 5.0, up = 1.8 / 5.0;
  const auto corner = [](double y, double z) { return std::atan(y * z / std::sqrt(1 + y * y + z * z)); };
  const double one_slit = corner(far_edge, up) - corner(near_edge, up) + corner(far_edge, down) - corner(near_edge, down);
  EXPECT_NEAR(double_slit().exact(double_slit_case().points[0])[screen], 2 * one_slit / (4 * pi), 1e-11);
}

TEST(DoubleSlit, TheClosedRoomLosesNothing) {
  double sum = 0.0;
  for (const double share : double_slit().exact(double_slit_case().points[0])) sum += share;
  EXPECT_NEAR(sum, 1.0, 1e-10);
  // Every model whose points all lie in directions from the source spreads all of its measure over the parts.
  for (const LaunchModel model : all_models) {
    double limit = 0.0;
    for (const LaunchLimit& part : double_slit().limits(double_slit().launch(model, site(), 2000))) limit += part.share;
    EXPECT_NEAR(limit, 1.0, 1e-9) << launch_model_name(model);
  }
}

// Seen from the front, both slits show 0.06 m x (2.5 - 0.4) m of the screen; the wall that the wave starts from has 24 m x 4 m.
TEST(DoubleSlit, LimitOfThePlaneWaveIsAProjectedArea) {
  const Launch launch = double_slit().launch(LaunchModel::plane_wave, site(), 100);
  EXPECT_NEAR(double_slit().limits(launch)[screen].share, 2 * 0.06 * 2.1 / 96.0, 1e-11);
}

class DoubleSlitModel : public ::testing::TestWithParam<LaunchModel> {};

TEST_P(DoubleSlitModel, AMillionRaysAreWithinTheBound) {
  const LaunchModel model = GetParam();
  const Launch launch = double_slit().launch(model, site(), 1000000);
  const RayHits hits = double_slit().trace(launch, 0);
  const std::vector<LaunchLimit> limits = double_slit().limits(launch);
  const std::vector<double> exact = double_slit().exact(double_slit_case().points[0]);
  const double rays = static_cast<double>(launch.rays());
  for (const Part part : {room, ground, wall, lintel, screen}) {
    const double direct = static_cast<double>(hits.parts[part].first_hits) / rays;
    EXPECT_LE(std::abs(direct - limits[part].share), limits[part].bound) << part;
    if (model == LaunchModel::plane_wave) continue;
    const double bound = model == LaunchModel::random ? hits.parts[part].estimate_bound : limits[part].estimate_bound;
    EXPECT_LE(std::abs(hits.parts[part].estimate - exact[part]), bound) << part;
  }
  // The bounds of patterns hold for the worst case, a border that runs along the cells all the way. Here a slit is at least 4
  // cells wide, and one of these may be counted wrong: the most for upright slits before an upright grid.
  EXPECT_NEAR(static_cast<double>(hits.parts[screen].first_hits) / rays / limits[screen].share, 1.0, 0.25);
}

INSTANTIATE_TEST_SUITE_P(Models, DoubleSlitModel, ::testing::ValuesIn(all_models), [](const auto& model) {
  std::string name(launch_model_name(model.param));
  std::erase(name, '-');
  return name;
});

// Thirty triangles anywhere, most of which cut others: what each of them shows to the source, by cutting and by counting.
TEST(TriangleSoup, EveryTrianglesShareIsThatOfTheRaysThatMeetIt) {
  std::vector<PolygonSoup> soups;
  for (std::uint64_t i = 0; i < 30; ++i) {
    PolygonSoup soup{{}, {{0, 1, 2}}};
    for (std::uint64_t corner = 0; corner < 3; ++corner) {
      const dvec2 across = random_point(7, 0, 6 * i + 2 * corner);
      const double z = random_point(7, 0, 6 * i + 2 * corner + 1).x;
      soup.points.emplace_back(2 * across.x - 1, 2 * across.y - 1, 2 * z - 1);
    }
    soups.push_back(soup);
  }
  const SourceScene scene(soups);
  const LaunchSite at = scene.site({0.1, -0.2, 0.05});
  const std::vector<double> exact = scene.exact({0.1, -0.2, 0.05});
  for (const LaunchModel model : all_models) {
    const Launch launch = scene.launch(model, at, 200000);
    const RayHits hits = scene.trace(launch, 0);
    const std::vector<LaunchLimit> limits = scene.limits(launch);
    for (std::size_t part = 0; part < soups.size(); ++part) {
      const double direct = static_cast<double>(hits.parts[part].first_hits) / static_cast<double>(launch.rays());
      EXPECT_LE(std::abs(direct - limits[part].share), limits[part].bound) << launch_model_name(model) << ' ' << part;
      if (model == LaunchModel::plane_wave) continue;
      const double bound = model == LaunchModel::random ? hits.parts[part].estimate_bound : limits[part].estimate_bound;
      EXPECT_LE(std::abs(hits.parts[part].estimate - exact[part]), bound) << launch_model_name(model) << ' ' << part;
      // Borders slant across these patterns, so what is found is far inside the bounds; only the triangles next to the source are
      // cut into cells too wide for that.
      if (model == LaunchModel::random || model == LaunchModel::geometry) continue;
      EXPECT_NEAR(hits.parts[part].estimate, exact[part], 2e-4) << launch_model_name(model) << ' ' << part;
    }
  }
}

// The scene is its own mirror image in y = 0 and the source lies there. Random rays know nothing of that: the two halves differ
// by less than four standard deviations of a difference of counts.
TEST(DoubleSlit, HitsAreSymmetric) {
  const RayHits hits = double_slit().trace(double_slit().launch(LaunchModel::random, site(), 1000000), 0, screen);
  ASSERT_GT(hits.hits.size(), 1000u);
  const auto left = std::ranges::count_if(hits.hits, [](const CountedHit& hit) { return hit.point.y > 0.0; });
  const double all = static_cast<double>(hits.hits.size());
  EXPECT_LE(std::abs(2.0 * static_cast<double>(left) - all), 4.0 * std::sqrt(all));
}

// Rays that got through bounce between the wall and the screen until they leave at the sides.
TEST(DoubleSlit, TheScreenIsHitSeveralTimesByOneRay) {
  const PartHits hits = double_slit().trace(double_slit().launch(LaunchModel::octahedron, site(), 500000)).parts[screen];
  EXPECT_GT(hits.all_hits, 2 * hits.first_hits);
  EXPECT_GT(hits.response, 2.0 * hits.estimate);
}

}  // namespace
}  // namespace raytube
