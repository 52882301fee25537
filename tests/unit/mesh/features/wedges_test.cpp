#include <algorithm>
#include <random>

#include "unit/mesh_shapes.h"

namespace raytube::shapes {
namespace {

TEST(MeshWedges, CubeHasTwelveRightEdges) {
  const LoadedMesh loaded = build(box(dvec3(0.0), dvec3(2.0)));
  EXPECT_EQ(loaded.report.components_closed, 1u);
  EXPECT_EQ(loaded.report.patches, 6u);
  EXPECT_TRUE(loaded.report.notes().empty());
  const auto wedges = wedges_of(loaded);
  EXPECT_EQ(count_by_n(wedges), (Count{{1.5, 12}}));
  for (const Wedge& wedge : wedges) {
    EXPECT_NEAR(wedge.n, 1.5, 1e-15);
    EXPECT_EQ(wedge.length(), 2.0);
    const dvec3 outward = 0.5 * (wedge.start + wedge.end);  // the cube is centred
    for (const WedgeFace& face : wedge.faces) {
      EXPECT_NEAR(face.width, 2.0, 1e-15);
      EXPECT_GT(glm::dot(face.normal, outward), 0.0);
      EXPECT_LT(glm::dot(face.into_face, outward), 0.0);
      EXPECT_EQ(face.normal, loaded.mesh.patches[face.patch].normal);
    }
  }
}

TEST(MeshWedges, RemeshingChangesNothing) {
  const auto coarse = wedges_of(build(cube())), fine = wedges_of(build(remeshed(cube(), 17, 17)));
  ASSERT_EQ(fine.size(), 12u);
  EXPECT_EQ(build(remeshed(cube(), 17, 17)).report.patches, 6u);
  // The thirds and sevenths of the fine mesh are rounded, so its faces are planes to an ulp or so.
  for (const Wedge& wedge : fine) {
    EXPECT_NEAR(wedge.n, 1.5, 1e-14);
    EXPECT_NEAR(wedge.length(), 1.0, 1e-15);
    const auto same = [&](const Wedge& w) {
      return glm::distance(w.start, wedge.start) + glm::distance(w.end, wedge.end) < 1e-15 ||
             glm::distance(w.start, wedge.end) + glm::distance(w.end, wedge.start) < 1e-15;
    };
    EXPECT_EQ(std::count_if(coarse.begin(), coarse.end(), same), 1);
  }
}

TEST(MeshWedges, RotationAndOffsetChangeNothing) {
  for (const double offset : {0.0, 1e3, 1e6}) {
    const LoadedMesh loaded = build(moved(remeshed(cube(), 9, 9), skew_rotation(), dvec3(offset, -2 * offset, 0.5 * offset)));
    EXPECT_EQ(loaded.report.patches, 6u);
    EXPECT_EQ(loaded.report.components_closed, 1u);
    const double rounding = 4e-16 * std::max(1.0, 2 * offset);  // of the coordinates in the file
    const auto wedges = wedges_of(loaded);
    EXPECT_EQ(wedges.size(), 12u);
    for (const Wedge& wedge : wedges) {
      EXPECT_NEAR(wedge.n, 1.5, 10 * rounding);
      EXPECT_NEAR(wedge.length(), 1.0, 4 * rounding);
    }
  }
}

TEST(MeshWedges, PlateHasFourHalfPlanes) {
  for (const int pieces : {1, 13}) {
    const LoadedMesh loaded = build(remeshed(plate({0, 0, 0}, {2, 0, 0}, {0, 3, 0}), pieces, pieces));
    EXPECT_EQ(loaded.report.components_closed, 0u);
    EXPECT_EQ(loaded.report.patches, 1u);
    EXPECT_EQ(glm::abs(loaded.mesh.patches[0].normal), dvec3(0, 0, 1));
    EXPECT_EQ(loaded.mesh.patches[0].offset, 0.0);
    const auto wedges = wedges_of(loaded);
    EXPECT_EQ(count_by_n(wedges), (Count{{2.0, 4}}));
    EXPECT_NEAR(total_length(wedges), 10.0, 1e-14);
    for (const Wedge& wedge : wedges) {
      EXPECT_EQ(wedge.n, 2.0);
      EXPECT_EQ(wedge.faces[0].normal, -wedge.faces[1].normal);
      EXPECT_EQ(wedge.faces[0].into_face, wedge.faces[1].into_face);
      EXPECT_NEAR(wedge.faces[0].width, 5.0 - wedge.length(), 1e-15);
      EXPECT_LT(glm::dot(wedge.faces[0].into_face, wedge.start), 0.0);
    }
  }
}

/// A loop whose lowest-numbered vertex lies in the middle of a side still starts its runs at corners.
TEST(MeshWedges, BorderRunsStartAtCorners) {
  PolygonSoup soup{{{1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 0}}, {{0, 1, 2, 3, 4, 5}}};
  EXPECT_EQ(wedges_of(build(soup)).size(), 4u);
}

TEST(MeshWedges, CreaseInAnOpenSurfaceIsAWedgeOnEachSide) {
  const PolygonSoup crease = joined(plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), plate({0, 0, 0}, {0, 1, 0}, {0, 0, 1}));
  const auto wedges = wedges_of(build(crease));
  EXPECT_EQ(count_by_n(wedges), (Count{{0.5, 1}, {1.5, 1}, {2.0, 6}}));
}

TEST(MeshWedges, CreasesOfAnyAngle) {
  for (const double angle : {20.0, 45.0, 100.0, 170.0}) {  // between the two leaves
    const dvec3 leaf{std::cos(angle * degree), 0, std::sin(angle * degree)};
    const auto wedges = wedges_of(build(joined(plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), plate({0, 0, 0}, {0, 1, 0}, leaf))), 5.0);
    std::vector<double> n;
    for (const Wedge& wedge : wedges)
      if (wedge.n != 2.0) n.push_back(wedge.n);
    std::sort(n.begin(), n.end());
    ASSERT_EQ(n.size(), 2u);
    EXPECT_NEAR(n[0], angle / 180.0, 1e-15);
    EXPECT_NEAR(n[1], 2.0 - angle / 180.0, 1e-15);
  }
}

TEST(MeshWedges, ConcaveEdgeOfAnLShapedPrism) {
  const LoadedMesh loaded = build(prism({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 1.0));
  EXPECT_NEAR(volume(loaded.mesh), 3.0, 1e-15);
  const auto wedges = wedges_of(loaded);
  EXPECT_EQ(count_by_n(wedges), (Count{{0.5, 1}, {1.5, 17}}));
  const auto concave = std::find_if(wedges.begin(), wedges.end(), [](const Wedge& w) { return !w.convex(); });
  EXPECT_NEAR(concave->faces[0].width, 1.0, 1e-15);
  EXPECT_NEAR(concave->interior_angle(), 1.5 * pi, 1e-14);
}

TEST(MeshWedges, TessellationOfACylinderIsSmooth) {
  for (const int sides : {36, 72, 144}) {
    const LoadedMesh loaded = build(cylinder(sides));
    EXPECT_EQ(loaded.report.patches, sides + 2u);
    EXPECT_EQ(count_by_n(wedges_of(loaded)), (Count{{1.5, 2 * sides}}));
  }
  EXPECT_EQ(count_by_n(wedges_of(build(cylinder(36)), 9.9)), (Count{{1.056, 36}, {1.5, 72}}));
}

TEST(MeshWedges, OpenSurfacesAroundOneEdge) {
  PolygonSoup star;
  for (int i = 0; i < 3; ++i) append(star, plate({0, 0, 0}, {0, 0, 1}, {std::cos(2 * pi * i / 3), std::sin(2 * pi * i / 3), 0}));
  EXPECT_EQ(count_by_n(wedges_of(build(star))), (Count{{0.667, 3}, {2.0, 9}}));

  PolygonSoup tee;
  for (const dvec3& arm : {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(-1, 0, 0)}) append(tee, plate({0, 0, 0}, {0, 0, 1}, arm));
  const LoadedMesh loaded = build(tee);
  EXPECT_EQ(loaded.report.non_manifold_edges, 1u);
  EXPECT_EQ(count_by_n(wedges_of(loaded)), (Count{{0.5, 2}, {2.0, 9}}));
  EXPECT_EQ(count_by_n(wedges_of(loaded, 0.0)), (Count{{0.5, 2}, {1.0, 1}, {2.0, 9}}));
}

TEST(MeshWedges, CubesTouchingAlongAnEdge) {
  const LoadedMesh loaded = build(joined(cube(), box({1, 1, 0}, {2, 2, 1})));
  EXPECT_EQ(loaded.report.components_closed, 2u);
  EXPECT_EQ(count_by_n(wedges_of(loaded)), (Count{{0.5, 2}, {1.5, 22}}));
}

TEST(MeshWedges, SurfaceFoldedFlatKeepsItsTwoLeaves) {
  const PolygonSoup soup{{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 0.7, 0}}, {{0, 1, 2}, {1, 0, 3}}};
  const LoadedMesh loaded = build(soup);
  EXPECT_EQ(loaded.report.patches, 2u);
  EXPECT_EQ(count_by_n(wedges_of(loaded)), (Count{{2.0, 5}}));  // two borders of each leaf, and the outside of the crease
}

/// A step lower than the flatness of patches belongs to both levels; its own edges point out of their plane.
TEST(MeshWedges, StepBelowToleranceIsNoEdge) {
  const double step = 1.5e-7 * std::sqrt(5.0);  // times the diagonal
  const LoadedMesh loaded =
      build(joined(joined(plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), plate({1, 0, 0}, {0, 0, step}, {0, 1, 0})),
                   plate({1, 0, step}, {1, 0, 0}, {0, 1, 0})));
  EXPECT_EQ(loaded.report.components, 1u);
  EXPECT_EQ(loaded.report.patches, 1u);
  EXPECT_EQ(total_length(wedges_of(loaded)), 6.0);
}

TEST(MeshWedges, SmoothSphereHasNone) {
  const LoadedMesh loaded = build(sphere(60));
  EXPECT_EQ(loaded.report.components_closed, 1u);
  EXPECT_TRUE(wedges_of(loaded).empty());
}

/// Lattice triangles at random: every defect at once. Only invariants can be checked.
TEST(MeshWedges, RandomSoupsKeepTheInvariants) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> coordinate(0, 3);
  for (int trial = 0; trial < 200; ++trial) {
    PolygonSoup soup;
    for (std::uint32_t i = 0; i < 40; ++i) {
      for (int k = 0; k < 3; ++k) soup.points.push_back({coordinate(random), coordinate(random), coordinate(random)});
      soup.polygons.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const LoadedMesh loaded = build(moved(soup, skew_rotation()));
    for (const Wedge& wedge : wedges_of(loaded)) {
      EXPECT_GT(wedge.n, 0.0);
      EXPECT_LE(wedge.n, 2.0 + 1e-12);
    }
    if (HasFailure()) break;
  }
}

}  // namespace
}  // namespace raytube::shapes
