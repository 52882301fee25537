// Pairs of edges between which nothing can stand, and pairs with something in between.
#include "utd/shadow/clear_between.h"

#include <gtest/gtest.h>

#include "unit/utd_scene.h"

namespace raytube {
namespace {

/// A floor 4 m wide in the plane z = 0, a wall of its own that stands on it in the plane y = 0, 2 m high, and their rims.
class FloorAndWall {
 public:
  FloorAndWall()
      : floor_(test::add_panel(mesh_, {0, 2, 0}, {2, 0, 0}, {0, 2, 0})),
        wall_(test::add_panel(mesh_, {0, 0, 1}, {2, 0, 0}, {0, 0, 1})) {}

  Wedge rim_of_floor() const { return test::half_plane({-2, 4, 0}, {2, 4, 0}, {0, -1, 0}, {0, 0, 1}, 4.0, floor_); }
  Wedge rim_of_wall() const { return test::half_plane({-2, 0, 2}, {2, 0, 2}, {0, 0, -1}, {0, 1, 0}, 2.0, wall_); }

  /// Between the rims there, with a panel of half sides a and b.
  bool is_clear_beside(const dvec3& center, const dvec3& a, const dvec3& b) const {
    TriangleMesh mesh = mesh_;
    test::add_panel(mesh, center, a, b);
    return is_clear_between(FaceTree(mesh), rim_of_floor(), rim_of_wall());
  }

  const TriangleMesh& mesh() const { return mesh_; }

 private:
  TriangleMesh mesh_;
  std::uint32_t floor_, wall_;
};

TEST(ClearBetween, OwnFacesDoNotCount) {
  const FloorAndWall scene;
  EXPECT_TRUE(is_clear_between(FaceTree(scene.mesh()), scene.rim_of_floor(), scene.rim_of_wall()));
}

TEST(ClearBetween, FacesInTheWayCount) {
  const FloorAndWall scene;
  EXPECT_FALSE(scene.is_clear_beside({0, 2, 1}, {0.1, 0, 0}, {0, 0, 0.1}));
  EXPECT_FALSE(scene.is_clear_beside({0, 2, 1}, {0.1, 0, 0}, {0, 0.1, -0.05}));  // within the plane of both rims
}

// Beneath the floor, on a side that touches both rims with its border, and beyond what is between them.
TEST(ClearBetween, FacesBesideDoNot) {
  const FloorAndWall scene;
  EXPECT_TRUE(scene.is_clear_beside({0, 2, -0.5}, {1, 0, 0}, {0, 1, 0}));
  EXPECT_TRUE(scene.is_clear_beside({2, 2, 1}, {0, 2, 0}, {0, 0, 1}));
  EXPECT_TRUE(scene.is_clear_beside({9, 2, 1}, {1, 0, 0}, {0, 0, 1}));
}

// Rays that run within the face of another body are left to rounding: they are asked one by one.
TEST(ClearBetween, EdgesOfOnePlaneAreNotTold) {
  TriangleMesh mesh;
  const std::uint32_t one = test::add_panel(mesh, {-3, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                      other = test::add_panel(mesh, {3, 0, 0}, {1, 0, 0}, {0, 1, 0});
  test::add_panel(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Wedge left = test::half_plane({-2, -1, 0}, {-2, 1, 0}, {-1, 0, 0}, {0, 0, 1}, 2.0, one),
              right = test::half_plane({2, -1, 0}, {2, 1, 0}, {1, 0, 0}, {0, 0, 1}, 2.0, other);
  EXPECT_FALSE(is_clear_between(FaceTree(mesh), left, right));
}

}  // namespace
}  // namespace raytube
