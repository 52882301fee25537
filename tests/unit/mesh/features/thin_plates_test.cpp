#include <algorithm>

#include "mesh/features/outlines.h"
#include "mesh/features/thin_plates.h"
#include "unit/mesh_shapes.h"

namespace raytube::shapes {
namespace {

constexpr double thickness = 0.05;
constexpr double limit = 0.1;  // wavelength 1 m

PolygonSoup thin_plate(double a = 3.0, double b = 2.0, double t = thickness) { return box(dvec3(0.0), dvec3(a, b, t)); }

/// A box plate whose border faces lean outwards by `lean` [rad] towards z = 0 and whose lower side is turned up by `taper` about
/// y.
PolygonSoup bent_plate(double lean, double taper) {
  PolygonSoup soup = thin_plate();
  const double out = thickness * std::tan(lean);
  for (dvec3& p : soup.points) {
    if (p.z > 0.0) continue;
    p.x += p.x > 0.0 ? out : -out;
    p.z += std::tan(taper) * (p.x - 1.5);
  }
  return soup;
}

std::vector<Wedge> merged(const LoadedMesh& loaded, double widest = limit) {
  const std::vector<Wedge> wedges = wedges_of(loaded);
  return merge_thin_plate_edges(wedges, find_thin_plate_edges(loaded.mesh, wedges), widest);
}

std::vector<Wedge> half_planes_of(const std::vector<Wedge>& wedges) {
  std::vector<Wedge> found;
  for (const Wedge& wedge : wedges)
    if (wedge.thickness() > 0.0) found.push_back(wedge);
  for (const Wedge& wedge : found) expect_proper(wedge);
  return found;
}

std::size_t radiating(const std::vector<Wedge>& wedges) {
  return static_cast<std::size_t>(std::ranges::count_if(wedges, [](const Wedge& w) { return w.stands_alone(); }));
}

TEST(MeshThinPlates, BoxPlateHasFourHalfPlanes) {
  const LoadedMesh loaded = build(thin_plate());
  const std::vector<Wedge> wedges = merged(loaded);
  const std::vector<Wedge> half_planes = half_planes_of(wedges);
  ASSERT_EQ(half_planes.size(), 4u);
  EXPECT_EQ(radiating(wedges), 4u);
  EXPECT_EQ(thin_plate_corners(wedges), 4u);
  EXPECT_NEAR(total_length(half_planes), 10.0, 1e-14);
  for (const Wedge& edge : half_planes) {
    EXPECT_NEAR(edge.n, 2.0, 1e-15);
    EXPECT_NEAR(edge.thickness(), thickness, 1e-15);
    EXPECT_NEAR(edge.start.z, 0.0, 1e-15);  // half-way, recentred
    EXPECT_NEAR(edge.end.z, 0.0, 1e-15);
    for (const WedgeFace& side : edge.faces) {
      EXPECT_NEAR(std::abs(side.normal.z), 1.0, 1e-15);
      EXPECT_GT(side.width, 1.9);
    }
    EXPECT_NEAR(std::abs(loaded.mesh.patches[edge.border_patch].normal.z), 0.0, 1e-15);
  }
}

TEST(MeshThinPlates, ThickPlatesAndOtherBodiesStayAsTheyAre) {
  for (const PolygonSoup& soup : {thin_plate(3, 2, 0.15), cube(), box(dvec3(0.0), dvec3(0.05)), thin_plate(3, 0.05, 0.05),
                                  cylinder(12), prism({{0, 0}, {1, 0}, {0, 0.08}}, 2.0)}) {
    const LoadedMesh loaded = build(soup);
    const std::vector<Wedge> before = wedges_of(loaded), after = merged(loaded);
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_EQ(after[i].start, before[i].start);
      EXPECT_TRUE(after[i].stands_alone());
    }
  }
}

TEST(MeshThinPlates, OpenPlatesHaveNoBorderFaces) {
  const LoadedMesh loaded = build(plate(dvec3(0.0), dvec3(3, 0, 0), dvec3(0, 2, 0)));
  EXPECT_TRUE(find_thin_plate_edges(loaded.mesh, wedges_of(loaded)).empty());
}

TEST(MeshThinPlates, RotationChangesNothing) {
  const auto half_planes = half_planes_of(merged(build(moved(thin_plate(), skew_rotation(), dvec3(0.3, -7, 2)))));
  ASSERT_EQ(half_planes.size(), 4u);
  EXPECT_NEAR(total_length(half_planes), 10.0, 1e-13);
  for (const Wedge& edge : half_planes) {
    EXPECT_NEAR(edge.n, 2.0, 1e-14);
    EXPECT_NEAR(edge.thickness(), thickness, 1e-14);
  }
}

TEST(MeshThinPlates, BorderFacesOfHolesCountToo) {
  PolygonSoup soup;
  for (const double z : {0.0, thickness})
    for (const double half : {2.0, 1.0})
      for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) soup.points.emplace_back(half * x, half * y, z);
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    soup.polygons.push_back({4 + i, 4 + j, j, i});            // lower side
    soup.polygons.push_back({8 + i, 8 + j, 12 + j, 12 + i});  // upper side
    soup.polygons.push_back({i, j, 8 + j, 8 + i});            // outer border face
    soup.polygons.push_back({12 + i, 12 + j, 4 + j, 4 + i});  // border face of the hole
  }
  const LoadedMesh loaded = build(soup);
  ASSERT_EQ(loaded.report.components_closed, 1u);
  const std::vector<Wedge> wedges = merged(loaded);
  const std::vector<Wedge> half_planes = half_planes_of(wedges);
  EXPECT_EQ(half_planes.size(), 8u);
  EXPECT_NEAR(total_length(half_planes), 24.0, 1e-14);
  EXPECT_EQ(radiating(wedges), 8u);

  // Across the plate from its outer edge to the hole, as on an open surface.
  const Outlines outlines(loaded.mesh, wedges, 15.0 * degree);
  for (std::uint32_t i = 0; i < wedges.size(); ++i) {
    if (wedges[i].thickness() == 0.0 || wedges[i].start.y != -2.0 || wedges[i].end.y != -2.0) continue;
    for (const WedgeFace& side : wedges[i].faces) {
      EXPECT_EQ(outlines.around(side).size(), 8u);
      const FaceExit exit = outlines.exit(side, i, {0.3, -2, 0}, {0, 1, 0});
      EXPECT_NEAR(exit.distance, 1.0, 1e-15);
      EXPECT_EQ(wedges[exit.edge->wedge].start.y, -1.0);
      EXPECT_EQ(wedges[exit.edge->wedge].faces[exit.edge->wedge_face].patch, side.patch);
    }
  }
}

TEST(MeshThinPlates, ARoundPlateHasAsManyAsItHasCorners) {
  std::vector<dvec2> outline;  // facets shorter than the plate is thick
  for (int i = 0; i < 200; ++i) outline.push_back({std::cos(2 * pi * i / 200), std::sin(2 * pi * i / 200)});
  const LoadedMesh loaded = build(prism(outline, thickness));
  const std::vector<Wedge> wedges = merged(loaded);
  EXPECT_EQ(half_planes_of(wedges).size(), 200u);
  EXPECT_EQ(radiating(wedges), 200u);
}

TEST(MeshThinPlates, SidesMayTaperAndBorderFacesLeanALittle) {
  EXPECT_EQ(half_planes_of(merged(build(bent_plate(0.0, 0.9 * degree)))).size(), 4u);
  EXPECT_EQ(half_planes_of(merged(build(bent_plate(15 * degree, 0.0)))).size(), 4u);
  EXPECT_EQ(half_planes_of(merged(build(bent_plate(25 * degree, 0.0)))).size(), 2u);  // the two that do not lean
  for (const Wedge& edge : half_planes_of(merged(build(bent_plate(0.0, 0.9 * degree))))) EXPECT_GT(edge.n, 2.0 - 1.0 / 180);
  const PolygonSoup knife = prism({{0, -0.04}, {3, -0.4}, {3, 0.4}, {0, 0.04}}, 2.0);  // 14 degrees between its sides
  EXPECT_TRUE(half_planes_of(merged(build(knife))).empty());
}

TEST(MeshThinPlates, ABorderFaceThatEndsHalfWayLeavesTheRestOfTheEdge) {
  // A box plate on a block whose sides x = 3 and y = 0 lie in the planes of two of its border faces.
  const double t = thickness;
  const PolygonSoup soup{{{0, 0, t},
                          {3, 0, t},
                          {3, 2, t},
                          {0, 2, t},
                          {0, 0, 0},
                          {3, 2, 0},
                          {0, 2, 0},
                          {2, 0, 0},
                          {2, 1, 0},
                          {3, 1, 0},
                          {2, 0, -1},
                          {2, 1, -1},
                          {3, 1, -1},
                          {3, 0, -1}},
                         {{0, 1, 2, 3},
                          {4, 6, 5, 9, 8, 7},
                          {13, 12, 9, 5, 2, 1},
                          {4, 7, 10, 13, 1, 0},
                          {4, 0, 3, 6},
                          {6, 3, 2, 5},
                          {7, 8, 11, 10},
                          {8, 9, 12, 11},
                          {10, 11, 12, 13}}};
  const LoadedMesh loaded = build(soup);
  ASSERT_EQ(loaded.report.components_closed, 1u);
  const std::vector<Wedge> wedges = merged(loaded);
  const std::vector<Wedge> half_planes = half_planes_of(wedges);
  ASSERT_EQ(half_planes.size(), 4u);
  EXPECT_NEAR(total_length(half_planes), 3.0 + 2.0 + 2.0 + 1.0, 1e-14);
  EXPECT_EQ(thin_plate_corners(wedges), 3u);
  double rest = 0.0;  // of the two upper edges above the block
  for (const Wedge& wedge : wedges)
    if (wedge.stands_alone() && wedge.start.z > 0.5 && wedge.end.z > 0.5 && wedge.thickness() == 0.0) rest += wedge.length();
  EXPECT_NEAR(rest, 2.0, 1e-14);
  // The outlines stay closed: each corner is the start of one edge.
  const Outlines outlines(loaded.mesh, wedges, 15.0 * degree);
  for (const WedgeFace& side : half_planes[0].faces)
    for (const OutlineEdge& edge : outlines.around(side)) {
      const auto starts_here = [&](const OutlineEdge& other) { return glm::distance(other.start, edge.end) < 1e-14; };
      EXPECT_EQ(std::ranges::count_if(outlines.around(side), starts_here), 1);
    }
}

TEST(MeshThinPlates, ThinAtOneFrequencyAndNotAtAnother) {
  const LoadedMesh loaded = build(thin_plate());
  const std::vector<ThinPlateEdge> edges = find_thin_plate_edges(loaded.mesh, wedges_of(loaded));
  EXPECT_EQ(edges.size(), 4u);
  EXPECT_EQ(count_thin(edges, speed_of_light), 4u);
  EXPECT_EQ(count_thin(edges, 2.1 * speed_of_light), 0u);
}

}  // namespace
}  // namespace raytube::shapes
