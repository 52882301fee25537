// Rays that wander inside a closed mesh never get out.
#include <gtest/gtest.h>

#include "shapes.h"
#include "walk.h"

namespace raytube {
namespace {

TEST(Watertight, CubeAndSphere) {
  // Edges are decided in double precision with the same number for both sides, so nothing slips through. The stress suite takes
  // the long walk, in bodies of every shape.
  EXPECT_EQ(testing::lost_inside(build_mesh(shapes::cube(1.0), 1.0).mesh, 300000, 1), 0u);
  EXPECT_EQ(testing::lost_inside(build_mesh(shapes::icosphere(4), 1.0).mesh, 300000, 2), 0u);
}

}  // namespace
}  // namespace raytube
