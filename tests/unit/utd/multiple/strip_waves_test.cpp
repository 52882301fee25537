// What goes on at the end of a strip.
#include "utd/multiple/strip_waves.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/load.h"
#include "unit/utd_scene.h"
#include "utd/multiple/wave_tree.h"

namespace raytube {
namespace {

// The current of the half plane's own side and that of the other one are the same, from one and the same source angle.
TEST(StripWaves, BothSidesOfAHalfPlaneGoOnAlike) {
  const test::Scene plate = test::plate(3.0, 2.0);
  StripWave wave;
  wave.strips_left = 2;
  wave.direction = glm::normalize(dvec3(1, 0.2, 0));
  OutlineEdge edge;
  edge.into_face = plate.wedges[0].faces[0].into_face;
  edge.wedge = 0;
  const auto beyond = waves_beyond(plate.wedges, wave, edge);
  ASSERT_TRUE(beyond);
  const auto& [own, other] = *beyond;
  EXPECT_EQ(own.sign, other.sign);
  EXPECT_EQ(own.incidence.source_angle, other.incidence.source_angle);
  EXPECT_EQ(own.direction, other.direction);
  EXPECT_EQ(own.incidence.tangent, -other.incidence.tangent);
}

// Two waves leave every edge of a plate, one over either side; both start the same ones at the next edge, which count twice.
TEST(StripWaves, WavesOverBothSidesOfAPlateStartEachWaveOnce) {
  PolygonSoup soup;
  soup.points = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  soup.polygons.push_back({0, 1, 2, 3});
  const LoadedMesh loaded = build_mesh(soup, 1.0);
  const std::vector<Wedge> wedges = find_wedges(loaded.mesh, 15.0 * degree);
  const Outlines outlines(loaded.mesh, wedges, 15.0 * degree);
  const dvec3 incident = glm::normalize(dvec3(0.2, 0.3, -1));
  WaveTree tree(wedges, outlines, nullptr, incident, -incident, false);
  const WedgeIncidence incidence = incidence_on(wedges[0], incident);
  const std::vector<LitInterval> lit{{0.0, 1.0}};
  tree.grow(first_wave(wedges, 0, 0, incidence.faces[0], incident, 3), lit);
  std::array<double, 4> signs{};  // the largest, by the strips that are left
  for (const TreeWave& each : tree.waves()) {
    signs[each.wave.strips_left] = std::max(signs[each.wave.strips_left], std::abs(each.wave.sign));
    const auto same = [&](const TreeWave& other) {
      return other.wave.wedge == each.wave.wedge && other.wave.face == each.wave.face &&
             other.wave.direction == each.wave.direction && other.path.value == each.path.value;
    };
    EXPECT_EQ(std::ranges::count_if(tree.waves(), same), 1);
  }
  EXPECT_EQ(signs[3], 1.0);
  EXPECT_EQ(signs[2], 1.0);
  EXPECT_EQ(signs[1], 2.0);
}

}  // namespace
}  // namespace raytube
