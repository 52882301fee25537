// Which surface a ray meets first, where single precision cannot tell.
#include "mesh/trace/tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "scene/material.h"
#include "shapes.h"

namespace raytube {
namespace {

const glm::dmat3 tilt(glm::rotate(glm::dmat4(1.0), 0.83, glm::normalize(dvec3(1, 2, 3))));

// Two unit plates, the second `gap` below the first and shifted a little sideways; corners rounded to float if asked.
TriangleMesh two_plates(double gap, bool round_to_float) {
  PolygonSoup soup;
  for (const dvec3& shift : {dvec3(0.0), dvec3(0.11, 0.07, -gap)})
    for (const dvec3& corner : {dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(1, 1, 0), dvec3(0, 1, 0)}) {
      dvec3 p = tilt * (corner + shift);
      for (int axis = 0; round_to_float && axis < 3; ++axis) {
        volatile float rounded = static_cast<float>(p[axis]);
        p[axis] = rounded;
      }
      soup.points.push_back(p);
    }
  soup.polygons = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  return build_mesh(soup, 1.0).mesh;
}

// Rays onto both plates from above, one a cell of a 60 x 60 grid, at 20 degrees from the normal.
std::vector<Ray> rays_from_above(const TriangleMesh& mesh) {
  std::vector<Ray> rays;
  const dvec3 direction = tilt * dvec3(std::sin(0.35), 0.0, -std::cos(0.35));
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 60; ++j) {
      const dvec3 target = tilt * dvec3(0.15 + 0.8 * (i + 0.3) / 60, 0.12 + 0.8 * (j + 0.6) / 60, 0.0) - mesh.center;
      rays.push_back({target - 1.5 * direction, direction, no_index});
    }
  return rays;
}

TEST(Tracer, TheUpperOfTwoPlatesIsMetHoweverThinTheGap) {
  for (const double gap : {1e-3, 1e-6, 3e-7, 1.6e-7}) {  // wider than the weld distance, or they are one plate
    const TriangleMesh mesh = two_plates(gap, false);
    ASSERT_EQ(mesh.patches.size(), 2u);
    const Tracer tracer(mesh);
    const std::vector<Ray> rays = rays_from_above(mesh);
    std::vector<Hit> hits(rays.size());
    tracer.closest_hits(rays, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_TRUE(hits[i]);
      EXPECT_NEAR(hits[i].distance, 1.5, 1e-12) << gap;  // the upper plate; rounding of coordinates of size 1
    }
  }
}

// Embree ends the program at such rays, where it is built with assertions.
TEST(Tracer, RaysThatAreNotFiniteMeetNothingAndLeaveOthersAlone) {
  const TriangleMesh mesh = build_mesh(shapes::icosphere(2), 1.0).mesh;
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const Ray good{dvec3(0.1, 0.2, 3.0), dvec3(0, 0, -1)};
  std::vector<Ray> rays(20, good);
  std::vector<std::size_t> strays;
  for (const double bad : {nan, infinity, -infinity, 1e30, 1e300})
    for (int axis = 0; axis < (std::isfinite(bad) ? 2 : 3); ++axis) {  // from afar along its way it would meet the sphere
      strays.push_back(strays.size() + 2);
      rays[strays.back()].origin[axis] = bad;
      if (!std::isfinite(bad) && axis == 1) rays[strays.back()] = good, rays[strays.back()].direction[axis] = bad;
    }
  for (const int packet : {1, 16}) {
    const Tracer tracer(mesh, packet);
    std::vector<Hit> hits(rays.size());
    std::vector<std::uint32_t> found(rays.size());
    tracer.closest_hits(rays, hits);
    tracer.any_blockers(rays, nothing_ignored, found);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool stray = std::ranges::find(strays, i) != strays.end();
      const std::uint32_t blocker = tracer.blocker(rays[i].origin, rays[i].direction, nothing_ignored);
      EXPECT_EQ(static_cast<bool>(hits[i]), !stray) << i;
      EXPECT_EQ(found[i] == no_index, stray) << i;
      EXPECT_EQ(blocker == no_index, stray) << i;
      if (!std::isfinite(glm::length(rays[i].origin) + glm::length(rays[i].direction))) {
        EXPECT_EQ(tracer.blocker_around(rays[i].origin, rays[i].direction, 0, nothing_ignored), no_index) << i;
      }
    }
  }
}

TEST(Tracer, ARayLeavesASurfaceIntoTheThinnestGap) {
  for (const double gap : {1e-3, 1e-6, 1.6e-7, 1e-9, 1e-12}) {
    const TriangleMesh mesh = two_plates(gap, false);
    const Tracer tracer(mesh);
    const std::uint32_t upper = mesh.triangle_patch[0];
    for (Ray ray : rays_from_above(mesh)) {
      ray.origin += 1.5 * ray.direction;  // on the upper plate, going down
      ray.source_patch = upper;
      Hit hit;
      tracer.closest_hits({&ray, 1}, {&hit, 1});
      ASSERT_TRUE(hit) << gap;
      EXPECT_NEAR(hit.distance, gap / std::cos(0.35), 1e-15) << gap;
    }
  }
}

TEST(Tracer, CoincidentPlatesOfASinglePrecisionFileTrapNoRay) {
  // Rounded to float the two planes cross each other here and there, 1e-8 apart; a reflected ray must get away all the same.
  const TriangleMesh mesh = two_plates(0.0, true);
  const Tracer tracer(mesh);
  std::vector<Ray> rays = rays_from_above(mesh);
  std::vector<Hit> hits(rays.size());
  tracer.closest_hits(rays, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_TRUE(hits[i]);
    const std::uint32_t patch = mesh.triangle_patch[hits[i].triangle];
    rays[i] = {rays[i].origin + hits[i].distance * rays[i].direction,
               reflected_direction(rays[i].direction, mesh.patches[patch].normal), patch};
  }
  tracer.closest_hits(rays, hits);
  for (const Hit& hit : hits) EXPECT_FALSE(hit);
}

TEST(Tracer, NeighboursNeverBothMissAnEdge) {
  // Rays exactly at and a rounding beside the diagonal that the plate's two triangles share.
  const TriangleMesh mesh = build_mesh(shapes::transformed(shapes::plate(2.0), tilt), 1.0).mesh;
  const Tracer tracer(mesh);
  for (const double beside : {0.0, 1e-17, 1e-16, 1e-12, 1e-9, 1e-7, 1e-5})
    for (const double sign : {-1.0, 1.0})
      for (int i = 1; i < 400; ++i) {
        const double x = -1.0 + i / 200.0;
        const Ray ray{tilt * dvec3(x, x + sign * beside, 1.0), tilt * dvec3(0, 0, -1), no_index};
        Hit hit;
        tracer.closest_hits({&ray, 1}, {&hit, 1});
        EXPECT_TRUE(hit) << x << ' ' << sign * beside;
      }
}

// Rays of a grid and of all their reflections, each followed with packets of its own width.
void expect_same_for_any_packet(const PolygonSoup& soup, const dvec3& direction) {
  const TriangleMesh mesh = build_mesh(PolygonSoup(soup), 1.0).mesh;
  const Tracer whole(mesh), singly(mesh, 1);
  const dvec3 u = glm::normalize(glm::cross(direction, dvec3(0.1, 0.2, 0.97))), v = glm::cross(u, direction);
  std::vector<Ray> rays;
  for (int i = 0; i < 300; ++i)
    for (int j = 0; j < 300; ++j)
      rays.push_back(
          {mesh.radius * ((i - 149.5) / 150.0 * u + (j - 149.5) / 150.0 * v - 1.001 * direction), direction, no_index});
  int bounces = 0;
  for (; !rays.empty(); ++bounces) {
    std::vector<Hit> by_16(rays.size()), by_1(rays.size());
    whole.closest_hits(rays, by_16);
    singly.closest_hits(rays, by_1);
    std::vector<Ray> next;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Hit hit = by_16[i];
      ASSERT_EQ(hit.triangle, by_1[i].triangle) << i << " of bounce " << bounces;
      ASSERT_EQ(hit.distance, by_1[i].distance);
      if (!hit) continue;
      const std::uint32_t patch = mesh.triangle_patch[hit.triangle];
      next.push_back({rays[i].origin + hit.distance * rays[i].direction,
                      reflected_direction(rays[i].direction, mesh.patches[patch].normal), patch});
    }
    rays = std::move(next);
  }
  EXPECT_GT(bounces, 1);
}

// What a query leaves out is left out by the filter, which Embree 4 takes and never calls unless told to.
TEST(Tracer, EmbreeCallsTheFilterOfEveryQuery) {
  const TriangleMesh mesh = two_plates(0.1, false);
  const std::vector<Ray> from_above = rays_from_above(mesh);
  for (const int packet : {1, 16}) {
    const Tracer tracer(mesh, packet);
    std::vector<Hit> hits(from_above.size());
    tracer.closest_hits(from_above, hits);
    std::vector<Ray> leaving;
    for (std::size_t i = 0; i < hits.size(); ++i)
      leaving.push_back({from_above[i].origin + hits[i].distance * from_above[i].direction, from_above[i].direction,
                         mesh.triangle_patch[hits[i].triangle]});
    const std::uint32_t upper = leaving.front().source_patch;
    std::vector<std::uint32_t> any(leaving.size());
    tracer.closest_hits(leaving, hits);
    tracer.any_blockers(from_above, {upper, no_index, no_index}, any);
    std::size_t met = 0;
    for (std::size_t i = 0; i < leaving.size(); ++i) {
      const std::uint32_t wanted = tracer.blocker(from_above[i].origin, from_above[i].direction, {upper, no_index, no_index});
      EXPECT_EQ(hits[i].triangle, wanted);
      EXPECT_EQ(any[i] == no_index, wanted == no_index);
      if (wanted == no_index) continue;
      ++met;
      EXPECT_NE(mesh.triangle_patch[wanted], upper);
    }
    EXPECT_GT(met, leaving.size() / 2);
  }
}

TEST(Tracer, HitsDoNotDependOnThePacket) {
  expect_same_for_any_packet(shapes::trihedral(1.0), glm::normalize(dvec3(-1.0, -0.8, -0.9)));
  expect_same_for_any_packet(shapes::icosphere(4), glm::normalize(dvec3(0.3, -0.5, -0.8)));
  expect_same_for_any_packet(shapes::cylinder(0.3, 1.0, 90), glm::normalize(dvec3(1.0, 0.2, 0.1)));
}

}  // namespace
}  // namespace raytube
