// What goes on at the end of a strip.
#include "utd/multiple/strip_waves.h"

#include <gtest/gtest.h>

#include "unit/utd_scene.h"

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

}  // namespace
}  // namespace raytube
