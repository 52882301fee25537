#include "mesh/features/resolved_wedges.h"
#include "unit/mesh_shapes.h"

namespace raytube::shapes {
namespace {

constexpr double limit = 0.01;

std::vector<Wedge> resolved(const LoadedMesh& loaded) {
  std::vector<Wedge> wedges = wedges_of(loaded);
  resolve_details(loaded.mesh, wedges, limit, 15 * degree);
  return wedges;
}

/// A closed prism, 1 wide, on this outline in the plane of x and y.
LoadedMesh profile(const std::vector<dvec2>& outline) { return build(prism(outline, 1.0)); }

/// Those of the prism's long edges that radiate near this line.
std::vector<Wedge> long_edges(const std::vector<Wedge>& wedges, const dvec3& center, const dvec2& at) {
  std::vector<Wedge> found;
  for (const Wedge& wedge : wedges) {
    const dvec3 middle = 0.5 * (wedge.start + wedge.end) + center;
    if (wedge.radiates() && wedge.length() > 0.9 && glm::length(dvec2(middle) - at) < 0.1) found.push_back(wedge);
  }
  return found;
}

TEST(ResolvedWedges, CleanBodiesStayAsTheyAre) {
  const LoadedMesh loaded = build(cube());
  const auto before = wedges_of(loaded), after = resolved(loaded);
  EXPECT_EQ(known_details(before, speed_of_light / (60 * limit)), 0.0);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].n, after[i].n);
    EXPECT_EQ(before[i].faces[0].into_face, after[i].faces[0].into_face);
    EXPECT_EQ(after[i].share, 1.0);
  }
}

TEST(ResolvedWedges, AStepIsFlatAndABluntEdgeIsOne) {
  constexpr double small = 1e-5;
  const LoadedMesh step = profile({{0, -1}, {2, -1}, {2, small}, {1, small}, {1, 0}, {0, 0}});
  EXPECT_TRUE(long_edges(resolved(step), step.mesh.center, {1, 0}).empty());
  EXPECT_EQ(long_edges(resolved(step), step.mesh.center, {2, 0}).size(), 1u);

  // A right-angled corner cut off at 45 degrees: two edges of n = 1.25, together one of n = 1.5.
  const LoadedMesh blunt = profile({{0, -1}, {1, -1}, {1, -small}, {1 - small, 0}, {0, 0}});
  const std::vector<Wedge> edges = long_edges(resolved(blunt), blunt.mesh.center, {1, 0});
  ASSERT_EQ(edges.size(), 2u);
  for (const Wedge& edge : edges) {
    EXPECT_NEAR(edge.n, 1.5, 1e-12);
    EXPECT_EQ(edge.share, 0.5);
    for (const WedgeFace& face : edge.faces) {
      EXPECT_NEAR(std::abs(glm::dot(face.into_face, blunt.mesh.patches[face.patch].normal)), 0.0, 1e-12);
      EXPECT_GT(face.width, 0.9);
      EXPECT_NEAR(glm::dot(face.into_face, face.normal), 0.0, 1e-15);
    }
  }
}

TEST(ResolvedWedges, AFaceOfMoreThanHalfTheLimitIsItself) {
  for (const double width : {1.1 * limit, 0.6 * limit, 0.4 * limit}) {
    const double side = width / std::sqrt(2.0);
    const LoadedMesh blunt = profile({{0, -1}, {1, -1}, {1, -side}, {1 - side, 0}, {0, 0}});
    const std::vector<Wedge> edges = long_edges(resolved(blunt), blunt.mesh.center, {1, 0});
    ASSERT_EQ(edges.size(), 2u) << width;
    for (const Wedge& edge : edges) {
      EXPECT_NEAR(edge.n, width > 0.5 * limit ? 1.25 : 1.5, 1e-9) << width;
      EXPECT_EQ(edge.share, width > 0.5 * limit ? 1.0 : 0.5) << width;
    }
  }
}

TEST(ResolvedWedges, ARibbonCountsByItsWidth) {
  for (const double width : {1e-4, 1e-3, 0.9 * limit}) {
    PolygonSoup ribbon{{{0, 0, 0}, {1, 0, 0}, {1, width, 0}, {0, width, 0}}, {{0, 1, 2, 3}}};
    for (const Wedge& wedge : resolved(build(ribbon))) {
      if (wedge.length() < 0.5) continue;
      EXPECT_NEAR(wedge.share, width / limit, 1e-12) << width;
    }
  }
}

TEST(ResolvedWedges, FrequenciesOfAnOctaveShareALimit) {
  for (const double frequency : {1e8, 3e9, 94e9}) {
    const double share = detail_limit(frequency) / wavelength(frequency);
    EXPECT_GT(share, 0.01);
    EXPECT_LE(share, 0.02);
  }
  EXPECT_EQ(detail_limit(10e9), detail_limit(10.1e9));
}

}  // namespace
}  // namespace raytube::shapes
