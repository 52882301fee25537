// The launch plane: how many cells, where they lie, where their rays leave.
#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "sbr/launch/launch.h"

namespace raytube {
namespace {

constexpr double rounding = 1e-14;  // a few operations on numbers of order one

// A box of the given sides; only its vertices matter to the launch plane.
TriangleMesh box(double x, double y, double z) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.vertices.push_back({i & 1 ? x / 2 : -x / 2, i & 2 ? y / 2 : -y / 2, i & 4 ? z / 2 : -z / 2});
  mesh.radius = glm::length(mesh.vertices.back());
  return mesh;
}

const Direction along_x{90 * degree, 0.0};  // u = +y, v = +z

LaunchGrid grid_along_x(const TriangleMesh& mesh, double wavelength, double per_wavelength, const std::optional<dvec3>& up = {}) {
  return launch_grid(mesh, along_x, wavelength, per_wavelength, up);
}

void expect_near(const dvec3& a, const dvec3& b) { EXPECT_NEAR(glm::distance(a, b), 0.0, rounding); }

TEST(LaunchGrid, CellsAreCountedUpToTheNextWholeOne) {
  const TriangleMesh mesh = box(1.0, 2.0, 0.31);
  const LaunchGrid grid = grid_along_x(mesh, 0.5, 10.0);  // cells of at most 0.05 m: 40 fit exactly, 6.2 need 7
  EXPECT_EQ(grid.columns, 40u);
  EXPECT_EQ(grid.rows, 7u);
}

TEST(LaunchGrid, AMillionthOfACellIsRoundingNotAnotherCell) {
  EXPECT_EQ(grid_along_x(box(1.0, 2.0 + 0.5e-6 * 0.05, 1.0), 0.5, 10.0).columns, 40u);
  EXPECT_EQ(grid_along_x(box(1.0, 2.0 + 2.0e-6 * 0.05, 1.0), 0.5, 10.0).columns, 41u);
}

// 10^6 along the longer side, from afar and from a point whence the box looks larger.
TEST(LaunchGrid, TheDensestOneIsTheLastNotRefused) {
  const TriangleMesh mesh = box(1.0, 2.0, 0.31);
  EXPECT_NEAR(densest_grid(mesh, {along_x, along_x}, 0.5, {}), 250000.0, 1e-6);
  for (const double range : {std::numeric_limits<double>::infinity(), 5.0}) {
    const Look look{along_x, along_x, range, range};
    const double most = densest_grid(mesh, look, 0.5, {});
    EXPECT_EQ(grid_of_look(mesh, look, 0.5, most, {}).columns, 1000000u);
    EXPECT_THROW(grid_of_look(mesh, look, 0.5, most * (1.0 + 1e-9), {}), InputError);
  }
}

TEST(LaunchGrid, CellsCoverTheExtentExactly) {
  const TriangleMesh mesh = box(0.7, 1.3, 0.9);
  const Direction look{37 * degree, 21 * degree};
  const LaunchGrid grid = launch_grid(mesh, look, 0.1, 7.3, {});
  double u_low = 1e9, u_high = -1e9, v_low = 1e9, v_high = -1e9;
  for (const dvec3& p : mesh.vertices) {
    u_low = std::min(u_low, glm::dot(p, grid.u_hat)), u_high = std::max(u_high, glm::dot(p, grid.u_hat));
    v_low = std::min(v_low, glm::dot(p, grid.v_hat)), v_high = std::max(v_high, glm::dot(p, grid.v_hat));
  }
  EXPECT_EQ(grid.u_begin, u_low);
  EXPECT_EQ(grid.v_begin, v_low);
  EXPECT_NEAR(grid.u_begin + grid.columns * grid.du, u_high, rounding);
  EXPECT_NEAR(grid.v_begin + grid.rows * grid.dv, v_high, rounding);
  EXPECT_NEAR(grid.u_center(0) - grid.du / 2, u_low, rounding);
  EXPECT_NEAR(grid.v_center(grid.rows - 1) + grid.dv / 2, v_high, rounding);
}

// Irrational shares of a cell, different ones: no mesh edge aligned with the grid ever lies under a whole row of rays.
TEST(LaunchGrid, RaysLeaveBesideTheCentreOfTheirCells) {
  const LaunchGrid grid = grid_along_x(box(1.0, 2.0, 0.31), 0.5, 10.0);
  for (const auto& [column, row] : {std::pair{0u, 0u}, {17u, 3u}, {39u, 6u}}) {
    const Ray ray = grid.ray(column, row);
    EXPECT_NEAR((glm::dot(ray.origin, grid.u_hat) - grid.u_center(column)) / grid.du, (std::sqrt(2.0) - 1) * 1e-2, 1e-13);
    EXPECT_NEAR((glm::dot(ray.origin, grid.v_hat) - grid.v_center(row)) / grid.dv, (std::sqrt(3.0) - 1) * 1e-2, 1e-13);
    EXPECT_EQ(ray.direction, grid.direction);
    EXPECT_EQ(ray.source_patch, no_index);
  }
}

TEST(LaunchGrid, LiesInFrontOfTheWholeTarget) {
  const TriangleMesh mesh = box(1.0, 2.0, 0.31);
  const LaunchGrid grid = launch_grid(mesh, {40 * degree, 30 * degree}, 0.5, 10.0, {});
  for (const dvec3& p : mesh.vertices) EXPECT_GT(glm::dot(p - grid.plane_origin, grid.direction), 0.0);
}

// The picture as the radar sees it: columns along phi-hat, rows along minus theta-hat, and u x v towards the radar.
TEST(LaunchGrid, AxesFollowTheTransmitDirection) {
  for (const Direction& look : {along_x, Direction{0.0, 0.0}, Direction{0.0, 1.0}, Direction{pi, 0.3}, Direction{1.1, -2.0}}) {
    const SphericalBasis basis = spherical_basis(look);
    const LaunchGrid grid = launch_grid(box(1, 1, 1), look, 0.5, 10.0, {});
    expect_near(grid.u_hat, basis.phi_hat);
    expect_near(grid.v_hat, -basis.theta_hat);
    expect_near(glm::cross(grid.u_hat, grid.v_hat), basis.radial);
    expect_near(grid.direction, -basis.radial);
  }
}

TEST(LaunchGrid, RowsFollowUpProjected) {
  const dvec3 up(0.4, 1.0, 2.0);  // across the line of sight: (0, 1, 2)
  const LaunchGrid grid = grid_along_x(box(1, 1, 1), 0.5, 10.0, up);
  expect_near(grid.v_hat, glm::normalize(dvec3(0, 1, 2)));
  expect_near(glm::cross(grid.u_hat, grid.v_hat), dvec3(1, 0, 0));
}

TEST(LaunchGrid, UpAlongTheLineOfSightFallsBackToThetaHat) {
  for (const double sign : {1.0, -1.0}) {
    const LaunchGrid grid = grid_along_x(box(1, 1, 1), 0.5, 10.0, dvec3(sign * 3.0, 0, 0));
    expect_near(grid.u_hat, dvec3(0, 1, 0));
    expect_near(grid.v_hat, dvec3(0, 0, 1));
  }
}

TEST(LaunchGrid, EdgeOnTargetHasNoCells) {
  for (const TriangleMesh& plate : {box(1.0, 1.0, 0.0), box(1.0, 0.0, 1.0)}) {
    const LaunchGrid grid = grid_along_x(plate, 0.5, 10.0);
    EXPECT_EQ(grid.cells(), 0u);
    EXPECT_EQ(grid.columns + grid.rows, 0u);
  }
}

}  // namespace
}  // namespace raytube
