#include <gtest/gtest.h>

#include "mesh/features/outlines.h"
#include "mesh/load.h"

namespace raytube {
namespace {

/// A square frame in z = 0: outer side 4, a hole of side 2 in the middle.
PolygonSoup frame() {
  PolygonSoup soup;
  for (const double half : {2.0, 1.0})
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) soup.points.emplace_back(half * x, half * y, 0.0);
  for (std::uint32_t i = 0; i < 4; ++i) soup.polygons.push_back({i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i});
  return soup;
}

TEST(MeshOutlines, LinesOnAFaceEndAtItsHoleAndAtItsBorder) {
  const LoadedMesh loaded = build_mesh(frame(), 1.0);
  const std::vector<Wedge> wedges = find_wedges(loaded.mesh, 15.0 * degree);
  ASSERT_EQ(wedges.size(), 8u);  // four borders outside, four round the hole
  const Outlines outlines(loaded.mesh, wedges, 15.0 * degree);
  for (std::uint32_t i = 0; i < wedges.size(); ++i) {
    if (wedges[i].start.y != -2.0 || wedges[i].end.y != -2.0) continue;
    for (const WedgeFace& face : wedges[i].faces) {
      EXPECT_EQ(outlines.around(face).size(), 8u);
      const FaceExit hole = outlines.exit(face, i, {0.3, -2, 0}, {0, 1, 0}),
                     border = outlines.exit(face, i, {1.5, -2, 0}, {0, 1, 0});
      EXPECT_NEAR(hole.distance, 1.0, 1e-15);
      EXPECT_NEAR(border.distance, 4.0, 1e-15);
      EXPECT_EQ(wedges[hole.edge->wedge].start.y, -1.0);
      EXPECT_EQ(wedges[border.edge->wedge].start.y, 2.0);
    }
  }
}

TEST(MeshOutlines, EveryCornerIsTheStartOfOneEdge) {
  const LoadedMesh loaded = build_mesh(frame(), 1.0);
  const std::vector<Wedge> wedges = find_wedges(loaded.mesh, 15.0 * degree);
  const Outlines outlines(loaded.mesh, wedges, 15.0 * degree);
  for (const dvec3& corner : loaded.mesh.vertices) {
    int starts = 0;
    for (const OutlineEdge& edge : outlines.around(wedges[0].faces[0])) starts += edge.start == corner;
    EXPECT_EQ(starts, 1);
  }
}

/// A cube with a coat on top: strips of conductors end at the coat's edges as at none.
TEST(MeshOutlines, EdgesOfOtherMaterialsAreApart) {
  PolygonSoup soup;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) soup.points.emplace_back(x, y, z);
  soup.polygons = {{4, 5, 6, 7}, {3, 2, 1, 0}};
  for (std::uint32_t i = 0; i < 4; ++i) soup.polygons.push_back({i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i});
  soup.materials = {0, no_index, no_index, no_index, no_index, no_index};
  const LoadedMesh loaded = build_mesh(soup, 1.0);
  const std::vector<Wedge> wedges = find_wedges(loaded.mesh, 15.0 * degree);
  ASSERT_EQ(wedges.size(), 12u);
  const Outlines outlines(loaded.mesh, wedges, 15.0 * degree);
  for (const Wedge& wedge : wedges)
    for (const WedgeFace& face : wedge.faces) {
      ASSERT_EQ(outlines.around(face).size(), 4u);
      for (const OutlineEdge& edge : outlines.around(face)) {
        ASSERT_NE(edge.any_wedge, no_index);
        EXPECT_EQ(edge.wedge, wedges[edge.any_wedge].conducting() ? edge.any_wedge : no_index);
        EXPECT_EQ(wedges[edge.any_wedge].faces[edge.wedge_face].patch, face.patch);
      }
    }
}

TEST(MeshOutlines, FlatCreasesAreMarkedSmooth) {
  // Two panels at 10 degrees, an edge for a threshold of 5 degrees and none for 15.
  const double c = std::cos(10 * degree), s = std::sin(10 * degree);
  const PolygonSoup soup{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-c, 0, s}, {-c, 1, s}}, {{0, 1, 2, 3}, {4, 0, 3, 5}}};
  const LoadedMesh loaded = build_mesh(soup, 1.0);
  for (const double threshold : {5.0, 15.0}) {
    const std::vector<Wedge> wedges = find_wedges(loaded.mesh, threshold * degree);
    const Outlines outlines(loaded.mesh, wedges, threshold * degree);
    const dvec3 shift = loaded.mesh.center;
    for (std::uint32_t i = 0; i < wedges.size(); ++i) {
      if (std::abs(wedges[i].start.x + shift.x - 1) > 1e-12 || std::abs(wedges[i].end.x + shift.x - 1) > 1e-12) continue;
      const FaceExit exit = outlines.exit(wedges[i].faces[0], i, (wedges[i].start + wedges[i].end) / 2.0, {-1, 0, 0});
      ASSERT_NE(exit.edge, nullptr);
      EXPECT_NEAR(exit.distance, 1.0, 1e-12);
      EXPECT_EQ(exit.edge->smooth, threshold > 10.0);
      EXPECT_EQ(exit.edge->wedge == no_index, threshold > 10.0);
    }
  }
}

}  // namespace
}  // namespace raytube
