// Which facets stand for a curved surface, and how well the surface found there is the one they were made from.
#include <gtest/gtest.h>

#include "mesh/features/smooth.h"
#include "mesh/load.h"
#include "mesh/trace/tracer.h"
#include "run.h"
#include "shapes.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double crease = 15.0 * degree;

// Where a ray along -z meets the mesh, and the surface there.
LocalSurface surface_below(const TriangleMesh& mesh, const SmoothSurfaces& smooth, double x, double y) {
  const Ray ray{{x, y, 10.0}, {0.0, 0.0, -1.0}};
  Hit hit;
  Tracer(mesh).closest_hits({&ray, 1}, {&hit, 1});
  return smooth.at(ray.origin, ray.direction, hit.triangle);
}

double largest_entry(const glm::dmat3& m) {
  double largest = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) largest = std::max(largest, std::abs(m[i][j]));
  return largest;
}

// Sides of h = 0.07 of the radius: parabolas over them leave the circle by h^4 / 128, their slope by h^3 / 16 (series of the
// circle); the patch between the sides by a few times that. Curvature is a derivative more.
TEST(SmoothSurfaces, SphereIsASphereAgain) {
  const LoadedMesh loaded = build_mesh(shapes::icosphere(4), 1.0);
  const SmoothSurfaces smooth(loaded.mesh, crease, 1.0);
  EXPECT_EQ(smooth.facets(), loaded.mesh.triangles.size());
  for (int i = 0; i < 40; ++i) {
    const LocalSurface s = surface_below(loaded.mesh, smooth, 0.9 * std::sin(1.0 + i), 0.35 * std::cos(2.3 * i));
    EXPECT_NEAR(glm::length(s.point), 1.0, 1e-6);
    EXPECT_LE(glm::length(s.normal - glm::normalize(s.point)), 1e-4);
    EXPECT_LE(largest_entry(s.curvature + glm::dmat3(1.0)), 0.03);
  }
}

TEST(SmoothSurfaces, CylinderBendsOneWayAndItsCapsNotAtAll) {
  const LoadedMesh loaded = build_mesh(shapes::cylinder(1.0, 4.0, 72), 1.0);
  const SmoothSurfaces smooth(loaded.mesh, crease, 1.0);
  std::size_t walls = 0;
  for (std::uint32_t t = 0; t < loaded.mesh.triangles.size(); ++t) {
    const bool wall = std::abs(loaded.mesh.patches[loaded.mesh.triangle_patch[t]].normal.z) < 0.5;
    EXPECT_EQ(smooth.region(t) != no_index, wall);
    walls += wall ? 1 : 0;
  }
  EXPECT_EQ(walls, 144u);
  const dvec3 origin(5.0, 0.31, 0.4), direction(-1.0, 0.0, 0.0);
  const Ray ray{origin, direction};
  Hit hit;
  Tracer(loaded.mesh).closest_hits({&ray, 1}, {&hit, 1});
  const LocalSurface s = smooth.at(origin, direction, hit.triangle);
  const dvec3 radial = glm::normalize(dvec3(s.point.x, s.point.y, 0.0)), around(-radial.y, radial.x, 0.0);
  // Side 0.087: h^4 / 128 = 4e-7, h^3 / 16 = 4e-5; curvature to h^2 / 8.
  EXPECT_NEAR(glm::length(dvec2(s.point)), 1.0, 1e-6);
  EXPECT_LE(glm::length(s.normal - radial), 1e-4);
  EXPECT_LE(largest_entry(s.curvature + glm::outerProduct(around, around) + glm::outerProduct(radial, radial)), 1e-3);
}

// A surface that would rise further from its facets than allowed is facets, and so is a body all of whose creases are wedges.
TEST(SmoothSurfaces, CoarseOrEdgedMeshesStayFacets) {
  const LoadedMesh sphere = build_mesh(shapes::icosphere(4), 1.0);
  EXPECT_FALSE(SmoothSurfaces(sphere.mesh, crease, 1e-4).any());  // sides of .07 rise by .07^2 / 8 = 6e-4
  EXPECT_FALSE(SmoothSurfaces(build_mesh(shapes::cube(1.0), 1.0).mesh, crease, 1.0).any());
}

// A wide panel that runs into a fillet of narrow facets, 5 degrees each: the panel keeps its plane, and the fillet begins along
// it.
TEST(SmoothSurfaces, PanelKeepsItsPlaneNextToAFillet) {
  PolygonSoup soup;
  std::vector<dvec2> profile{{-3.0, 0.0}, {0.0, 0.0}};
  for (int i = 0; i < 6; ++i) {
    const double slope = -(2.5 + 5.0 * i) * degree;
    profile.push_back(profile.back() + 0.1 * dvec2(std::cos(slope), std::sin(slope)));
  }
  for (const dvec2& p : profile) soup.points.insert(soup.points.end(), {dvec3(p.x, -1.0, p.y), dvec3(p.x, 1.0, p.y)});
  for (std::uint32_t i = 0; i + 1 < profile.size(); ++i) soup.polygons.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  const LoadedMesh loaded = build_mesh(soup, 1.0);
  const SmoothSurfaces smooth(loaded.mesh, crease, 1.0);
  const dvec3 shift = loaded.mesh.center;
  const LocalSurface panel = surface_below(loaded.mesh, smooth, -1.0 - shift.x, 0.1);
  EXPECT_EQ(std::abs(panel.normal.z), 1.0);
  EXPECT_EQ(largest_entry(panel.curvature), 0.0);
  const LocalSurface start = surface_below(loaded.mesh, smooth, 0.002 - shift.x, 0.1);
  // The panel's normal turns into the middle one of the next two facets, 5 degrees, over 0.1: 0.1 degrees on 0.002.
  EXPECT_LE(std::acos(std::abs(start.normal.z)), 0.2 * degree);
}

}  // namespace
}  // namespace raytube
