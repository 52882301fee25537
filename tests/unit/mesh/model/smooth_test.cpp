// Which facets stand for a curved surface, and how well the surface found there is the one they were made from.
#include "mesh/smooth/smooth.h"

#include <gtest/gtest.h>

#include "mesh/load.h"
#include "mesh/smooth/bodies.h"
#include "mesh/trace/tracer.h"
#include "run.h"
#include "shapes.h"
#include "smooth_bodies.h"

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
    const bool wall = std::abs(loaded.mesh.patch_of(t).normal.z) < 0.5;
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

// Facets near the poles are smaller than those about the equator, and rise by less: a limit between makes all facets, or none.
TEST(SmoothSurfaces, ASurfaceIsCurvedAsAWholeOrNotAtAll) {
  const LoadedMesh uneven = build_mesh(shapes::spheroid(shapes::FacetKind::longitudes, 1.0, 1.0, 2000), 1.0);
  const double rise = SmoothSurfaces(uneven.mesh, crease).rise();
  for (const double limit : {0.02 * rise, 0.2 * rise, 0.5 * rise, 1.1 * rise}) {
    const std::size_t facets = SmoothSurfaces(uneven.mesh, crease, limit).facets();
    EXPECT_TRUE(facets == 0 || facets == uneven.mesh.triangles.size()) << facets;
  }
  EXPECT_EQ(SmoothSurfaces(uneven.mesh, crease, 1.1 * rise).facets(), uneven.mesh.triangles.size());
  EXPECT_FALSE(SmoothSurfaces(uneven.mesh, crease, 0.02 * rise).any());
}

TEST(SmoothSurfaces, EdgedBodiesStayFacets) {
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

// Where the long facets of a cylinder meet the first ring of a dome, these alone give the normals: they are straight along the
// axis, however far they reach, and bend about it as the dome does.
TEST(SmoothSurfaces, WallOfACapsuleIsStraightAndRound) {
  const LoadedMesh loaded = build_mesh(shapes::capsule(1.0, 20.0, 72), 1.0);
  const SmoothSurfaces smooth(loaded.mesh, crease);
  EXPECT_EQ(smooth.facets(), loaded.mesh.triangles.size());
  for (std::uint32_t t = 0; t < loaded.mesh.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      const Triangle& corners = loaded.mesh.triangles[t];
      const dvec3 side = loaded.mesh.vertices[corners[(c + 1) % 3]] - loaded.mesh.vertices[corners[c]];
      if (glm::length(side) < 10.0) continue;
      // Of a dome's first ring, one facet wide, a normal between the two would bend a side of 20 by 20 x 2.5 degrees.
      const bool along_axis = glm::length(dvec2(side)) < 1e-9;
      EXPECT_LE(glm::length(smooth.bend(t, c)), along_axis ? 1e-9 : 0.004);  // the circle's chord of 5 degrees rises by .001
    }
}

// Facets of all shapes, half of them with a neighbour a quarter as wide: none of them is a panel, and normals are those of the
// sphere, for which their weights are exact.
TEST(SmoothSurfaces, UnevenFacetsOfASphereAreNoPanels) {
  const LoadedMesh loaded = build_mesh(shapes::spheroid(shapes::FacetKind::uneven, 1.0, 1.0, 4000), 1.0);
  const SmoothSurfaces smooth(loaded.mesh, 40.0 * degree);
  EXPECT_EQ(smooth.facets(), loaded.mesh.triangles.size());
  for (std::uint32_t t = 0; t < loaded.mesh.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      const dvec3 at = loaded.mesh.vertices[loaded.mesh.triangles[t][c]] + loaded.mesh.center;
      EXPECT_LE(glm::length(smooth.normal(t, c) - glm::normalize(at)), 1e-9);
    }
}

// One row of facets from the base to the tip: no facet's normal is that of the tip, along which the sides to it would bulge by a
// quarter of their length and more. They are straight, as those of the cone, and only its base is round.
TEST(SmoothSurfaces, ConeOfOneRowIsStraightToItsTip) {
  const auto meridian = [](double s) { return s < 0.5 ? dvec2(0.3 * s, 0.5 - s) : dvec2(0.3 * (1.0 - s), 0.0); };
  for (const std::uint32_t sides : {26u, 40u}) {
    const LoadedMesh loaded = build_mesh(shapes::revolution(meridian, {0.0, 0.5, 1.0}, sides), 1.0);
    const SmoothSurfaces smooth(loaded.mesh, crease);
    EXPECT_EQ(smooth.facets(), sides);
    EXPECT_LE(smooth.rise(), 0.15 * (pi / sides) * (pi / sides));
    const double chord = 0.3 * std::sin(pi / sides);
    for (std::uint32_t t = 0; t < loaded.mesh.triangles.size(); ++t)
      for (int c = 0; c < 3; ++c) {
        const Triangle& corners = loaded.mesh.triangles[t];
        const double side = glm::distance(loaded.mesh.vertices[corners[c]], loaded.mesh.vertices[corners[(c + 1) % 3]]);
        if (smooth.region(t) == no_index || side <= 1.01 * chord) continue;
        EXPECT_LE(glm::length(smooth.bend(t, c)), 1e-9);
      }
  }
}

std::size_t facets_of_bodies_apart(const PolygonSoup& soup) {
  const LoadedMesh loaded = build_mesh(soup, 1.0);
  const std::optional<SmoothSurfaces> bodies = bodies_apart(FaceTree(loaded.mesh), crease);
  return bodies ? bodies->facets() : 0;
}

PolygonSoup moved(const PolygonSoup& soup, const dvec3& by) { return shapes::transformed(soup, glm::dmat3(1.0), 1.0, by); }

// A plate of 2 x 2 whose corners are all further away than its middle; its diagonal does not run under the sphere.
TEST(BodiesApart, KeepAwayFromFacesAsWellAsFromCorners) {
  const PolygonSoup sphere = shapes::icosphere(3, 0.5);
  const std::size_t all = sphere.polygons.size();
  for (const auto& [height, facets] : {std::pair{0.99, std::size_t{0}}, std::pair{1.02, all}})
    EXPECT_EQ(facets_of_bodies_apart(shapes::joined(sphere, moved(shapes::plate(6.0), {1.0, 0.5, -height}))), facets) << height;
}

// Turned as a whole nothing changes.
TEST(BodiesApart, TakesEachBodyByItself) {
  const PolygonSoup sphere = shapes::icosphere(3, 1.0), small = shapes::icosphere(3, 0.4), cube = shapes::cube(1.0);
  const std::size_t all = sphere.polygons.size();
  const glm::dmat3 turn(0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6);
  const auto facets = [&](const PolygonSoup& set) {
    const std::size_t count = facets_of_bodies_apart(set);
    EXPECT_EQ(facets_of_bodies_apart(shapes::transformed(set, turn)), count);
    return count;
  };
  EXPECT_EQ(facets(shapes::joined(sphere, moved(small, {5.0, 0.0, 0.0}))), 2 * all);
  EXPECT_EQ(facets(shapes::joined(sphere, moved(small, {2.2, 0.0, 0.0}))), all);  // the large one is too near to the small
  EXPECT_EQ(facets(shapes::joined(sphere, moved(small, {1.5, 0.0, 0.0}))), 0u);
  EXPECT_EQ(facets(shapes::joined(sphere, moved(cube, {4.0, 0.0, 0.0}))), all);
  EXPECT_EQ(facets(shapes::joined(cube, moved(cube, {4.0, 0.0, 0.0}))), 0u);
}

// What is open or hollow counts as its facets.
TEST(BodiesApart, AreConvexAndClosed) {
  const PolygonSoup far_away = moved(shapes::cube(1.0), {20.0, 0.0, 0.0});
  PolygonSoup bowl = shapes::icosphere(3, 1.0);
  std::erase_if(bowl.polygons, [&](const auto& polygon) { return bowl.points[polygon[0]].z > 0.5; });
  EXPECT_EQ(facets_of_bodies_apart(shapes::joined(bowl, far_away)), 0u);
  PolygonSoup dented = shapes::icosphere(3, 1.0);
  for (dvec3& point : dented.points)
    point *= 1.0 - 0.3 * std::exp(-4.0 * glm::dot(point - dvec3(0, 0, 1), point - dvec3(0, 0, 1)));
  EXPECT_EQ(facets_of_bodies_apart(shapes::joined(dented, far_away)), 0u);
}

// Creases of 15 degrees to rounding, as a wall of 24 sides has: none is an edge.
TEST(SmoothSurfaces, ThresholdToRoundingIsTessellation) {
  const Target target(build_mesh(shapes::cylinder(0.15, 0.5, 24), 1.0).mesh);
  EXPECT_EQ(target.wedges.size(), 48u);  // of both rims
  EXPECT_EQ(SmoothSurfaces(target.mesh, target.options.min_wedge_angle).facets(), 48u);
}

// A needle that is folded over within the plane of its neighbours has no say in which side is outside; of ends whose normals are
// opposite no side bends: both were no numbers.
TEST(SmoothSurfaces, FoldedNeedlesKeepNormalsAndBendsNumbers) {
  PolygonSoup soup = shapes::cylinder(1.0, 2.0, 48);
  const LoadedMesh round = build_mesh(soup, 1.0);
  for (std::uint32_t i = 0; i < 40; ++i) {
    // Beside a side of a facet, half of them turned over.
    const auto& polygon = soup.polygons[i];
    const std::uint32_t a = polygon[0], b = polygon[1];
    soup.points.push_back(0.5 * (soup.points[a] + soup.points[b]) + (i % 2 ? 1e-7 : -1e-7) * dvec3(0.3, 0.5, 0.8));
    soup.polygons.push_back({a, b, static_cast<std::uint32_t>(soup.points.size() - 1)});
  }
  const LoadedMesh loaded = build_mesh(soup, 1.0);
  const SmoothSurfaces smooth(loaded.mesh, 30.0 * degree);
  for (std::uint32_t t = 0; t < loaded.mesh.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(glm::length(smooth.normal(t, c)), 1.0, 1e-9);
      EXPECT_LT(glm::length(smooth.bend(t, c)), 1.0);
    }
}

}  // namespace
}  // namespace raytube
