// Waves over curved surfaces run where they can change the answer, and only there.
#include <gtest/gtest.h>

#include <cstring>

#include "run.h"
#include "smooth_bodies.h"

namespace raytube {
namespace {

using namespace raytube::testing;

const std::vector<Direction> looks = {{83 * degree, 7 * degree}, {47 * degree, 31 * degree}, {20 * degree, 200 * degree}};

SweepResult solved(const PolygonSoup& soup, double frequency, Use waves) {
  SolveOptions options;
  options.surfaces.waves = waves;
  return solve_soup(soup, monostatic(looks, frequency), options);
}

bool same(const SweepResult& a, const SweepResult& b) {
  return std::memcmp(a.total.data(), b.total.data(), a.total.size() * sizeof(ScatteringMatrix)) == 0;
}

std::uint64_t looks_without(const SweepResult& result) {
  std::uint64_t count = 0;
  for (const Skipped& item : result.statistics.skipped)
    if (item.why.starts_with("too weak compared with the tubes")) count += item.count;
  return count;
}

// Sphere of .3 m at 10 GHz, ka 63: 1 / 2ka of the amplitude, .07 dB, is below the tolerance of .1 dB.
TEST(SurfaceWaves, AreLeftOutWhereTheyAddLessThanTheTolerance) {
  const PolygonSoup sphere = shapes::spheroid(shapes::FacetKind::geodesic, 0.3, 0.3, 2000);
  const SweepResult found = solved(sphere, 10e9, {}), without = solved(sphere, 10e9, false), forced = solved(sphere, 10e9, true);
  EXPECT_EQ(looks_without(found), looks.size());
  EXPECT_TRUE(same(found, without));
  EXPECT_EQ(looks_without(forced), 0u);
  EXPECT_FALSE(same(found, forced));
  for (std::size_t i = 0; i < looks.size(); ++i) {
    EXPECT_NEAR(dbsm(found.total[i].vv()), dbsm(forced.total[i].vv()), 0.1);  // the tolerance
    EXPECT_EQ(found.model[i], without.model[i]);
  }
}

// At ka 10 they are worth .4 dB; on a spheroid 2:1 as much or more.
TEST(SurfaceWaves, RunWhereTheyMatter) {
  for (const double a : {0.3, 0.15}) {
    const PolygonSoup body = shapes::spheroid(shapes::FacetKind::geodesic, a, 0.3, 2000);
    const double frequency = 10.0 * speed_of_light / (2.0 * pi * 0.3);
    const SweepResult found = solved(body, frequency, {});
    EXPECT_EQ(looks_without(found), 0u);
    EXPECT_TRUE(same(found, solved(body, frequency, true)));
  }
}

}  // namespace
}  // namespace raytube
