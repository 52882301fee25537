#include <algorithm>

#include "core/error.h"
#include "unit/mesh_shapes.h"

namespace raytube::shapes {
namespace {

TEST(MeshRepair, ScalesToMetresAndRecentres) {
  const LoadedMesh loaded = build(box({10, 20, 30}, {12, 24, 36}), 1e-3);
  EXPECT_NEAR(glm::distance(loaded.mesh.center, dvec3(0.011, 0.022, 0.033)), 0.0, 1e-17);
  EXPECT_NEAR(loaded.mesh.radius, 1e-3 * std::sqrt(14.0), 1e-17);
  EXPECT_NEAR(loaded.report.weld_distance, 1e-7 * 2e-3 * std::sqrt(14.0), 1e-22);
  EXPECT_NEAR(volume(loaded.mesh), 48e-9, 1e-22);
}

TEST(MeshRepair, UnusedVerticesDoNotMoveTheCentre) {
  PolygonSoup soup = cube();
  soup.points.push_back({1000, 0, 0});
  const LoadedMesh loaded = build(soup);
  EXPECT_EQ(loaded.mesh.center, dvec3(0.5));
  EXPECT_EQ(loaded.mesh.vertices.size(), 8u);
  EXPECT_EQ(loaded.report.vertices_read, 9u);
}

TEST(MeshRepair, WeldsWithinItsDistanceOnly) {
  for (const auto& [gap, components] : {std::pair(0.5e-7, 1u), std::pair(3e-7, 2u)}) {
    const double shift = gap * std::sqrt(5.0);  // times the diagonal
    const LoadedMesh loaded =
        build(joined(plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), plate({1 + shift, 0, 0}, {1, 0, 0}, {0, 1, 0})));
    EXPECT_EQ(loaded.report.components, components);
    EXPECT_EQ(loaded.report.vertices_welded, components == 1 ? 2u : 0u);
  }
}

TEST(MeshRepair, TurnsAnInsideOutCube) {
  PolygonSoup soup = cube();
  for (Polygon& polygon : soup.polygons) std::reverse(polygon.begin(), polygon.end());
  const LoadedMesh loaded = build(soup);
  EXPECT_EQ(loaded.report.triangles_flipped, 12u);
  EXPECT_NEAR(volume(loaded.mesh), 1.0, 1e-15);
  for (const Patch& patch : loaded.mesh.patches) EXPECT_EQ(patch.offset, 0.5);  // outward from the centre
}

TEST(MeshRepair, WindsAMixedCubeOutward) {
  PolygonSoup soup = cube();
  for (const int i : {0, 3, 4}) std::reverse(soup.polygons[i].begin(), soup.polygons[i].end());
  const LoadedMesh loaded = build(soup);
  EXPECT_EQ(loaded.report.triangles_flipped, 6u);
  EXPECT_EQ(loaded.report.badly_wound_edges_read, 6u);  // the border of three faces around a corner
  EXPECT_NEAR(volume(loaded.mesh), 1.0, 1e-15);
  EXPECT_EQ(loaded.report.components_closed, 1u);
}

TEST(MeshRepair, OpenSurfacesKeepTheWindingOfTheirMajority) {
  PolygonSoup soup = remeshed(plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 4, 4);
  for (const int i : {0, 1, 2, 17}) std::reverse(soup.polygons[i].begin(), soup.polygons[i].end());
  const LoadedMesh loaded = build(soup);
  EXPECT_EQ(loaded.report.triangles_flipped, 4u);
  EXPECT_EQ(loaded.mesh.patches[0].normal, dvec3(0, 0, 1));
}

TEST(MeshRepair, MoebiusStripIsOneOpenSurface) {
  PolygonSoup soup;
  const auto at = [](int i, double side) {
    const double phi = 2 * pi * i / 40, r = 1 + side * std::cos(phi / 2);
    return dvec3(r * std::cos(phi), r * std::sin(phi), side * std::sin(phi / 2));
  };
  for (int i = 0; i < 40; ++i) append(soup, {{at(i, -0.3), at(i, 0.3), at(i + 1, 0.3), at(i + 1, -0.3)}, {{0, 1, 2}, {0, 2, 3}}});
  const LoadedMesh loaded = build(soup);
  EXPECT_EQ(loaded.report.components, 1u);
  EXPECT_EQ(loaded.report.components_closed, 0u);
  EXPECT_EQ(loaded.report.triangles_traced, 80u);
}

TEST(MeshRepair, KeepsOneOfSeveralCopies) {
  const LoadedMesh loaded = build(joined(cube(), joined(cube(), cube())));
  EXPECT_EQ(loaded.report.triangles_duplicate, 24u);
  EXPECT_EQ(loaded.report.components_closed, 1u);
  EXPECT_EQ(wedges_of(loaded).size(), 12u);
}

TEST(MeshRepair, KeepsOneOfTwoCubesInsideOneAnother) {
  const PolygonSoup outward = remeshed(cube(), 1, 1);
  PolygonSoup inward = outward;
  for (Polygon& polygon : inward.polygons) std::reverse(polygon.begin(), polygon.end());
  const LoadedMesh loaded = build(joined(outward, inward));
  EXPECT_EQ(loaded.report.triangles_duplicate, 12u);
  EXPECT_EQ(loaded.report.components_closed, 1u);
}

TEST(MeshRepair, SurfaceDrawnFromBothSidesIsOne) {
  const PolygonSoup front{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const PolygonSoup back{front.points, {{0, 2, 1}, {0, 3, 2}}};
  const LoadedMesh loaded = build(joined(front, back));
  EXPECT_EQ(loaded.report.triangles_duplicate, 2u);
  EXPECT_EQ(count_by_n(wedges_of(loaded)), (Count{{2.0, 4}}));
}

TEST(MeshRepair, RemovesTheWallBetweenTouchingCubes) {
  PolygonSoup left = cube(), right = box({1, 0, 0}, {2, 1, 1});
  left.polygons[5] = {1, 3, 7, 5};  // the wall from both sides, with fans along the same diagonal
  right.polygons[4] = {0, 4, 6, 2};
  const LoadedMesh loaded = build(joined(left, right));
  EXPECT_EQ(loaded.report.triangles_internal, 4u);
  EXPECT_EQ(loaded.report.components, 1u);
  EXPECT_EQ(loaded.report.components_closed, 1u);
  EXPECT_EQ(loaded.report.patches, 6u);
  EXPECT_NEAR(volume(loaded.mesh), 2.0, 1e-15);
  EXPECT_EQ(count_by_n(wedges_of(loaded)), (Count{{1.5, 12}}));
}

/// A tube on a box divides its top: neither part of it nor the rest is closed by itself.
TEST(MeshRepair, BoxUnderATubeIsClosed) {
  PolygonSoup soup = cube();
  soup.polygons.erase(soup.polygons.begin() + 1);
  append(soup, remeshed(plate({0, 0, 1}, {1, 0, 0}, {0, 1, 0}), 4, 4));
  PolygonSoup tube = box({0.25, 0.25, 1}, {0.75, 0.75, 2});
  tube.polygons.erase(tube.polygons.begin(), tube.polygons.begin() + 2);
  append(soup, remeshed(tube, 2, 2));
  const LoadedMesh loaded = build(soup);
  EXPECT_EQ(loaded.report.components, 2u);
  EXPECT_EQ(loaded.report.components_closed, 1u);
  // The foot outside and inside, the tube's corners likewise, its free border.
  EXPECT_EQ(count_by_n(wedges_of(loaded)), (Count{{0.5, 4 + 4 + 4}, {1.5, 12 + 4}, {2.0, 4}}));
}

/// A wall is one whatever its diagonals, and also if one of its sides is subdivided.
TEST(MeshRepair, WallsWithDifferentTrianglesAreTakenOutToo) {
  PolygonSoup turned = box({1, 0, 0}, {2, 1, 1});
  turned.polygons[4] = {4, 6, 2, 0};
  for (const PolygonSoup& right : {turned, remeshed(turned, 3, 2)}) {
    const LoadedMesh loaded = build(joined(cube(), right));
    EXPECT_EQ(loaded.report.components_closed, 1u);
    EXPECT_NEAR(volume(loaded.mesh), 2.0, 1e-14);
    EXPECT_EQ(count_by_n(wedges_of(loaded)), (Count{{1.5, 12}}));
  }
}

/// Boxes of different sizes share no face, only a part of one: both stay whole.
TEST(MeshRepair, WallsThatOverlapInPartStay) {
  const LoadedMesh loaded = build(joined(box({0, 0, 0}, {3, 3, 1}), box({1, 1, 1}, {2, 2, 2})));
  EXPECT_EQ(loaded.report.components_closed, 2u);
  EXPECT_EQ(loaded.report.triangles_traced, 24u);
}

PolygonSoup reversed(PolygonSoup soup) {
  for (Polygon& polygon : soup.polygons) std::ranges::reverse(polygon);
  return soup;
}

/// The first corner of each polygon, and with it the diagonals of its triangles, goes round.
PolygonSoup rotated(PolygonSoup soup) {
  for (Polygon& polygon : soup.polygons) std::ranges::rotate(polygon, polygon.begin() + 1);
  return soup;
}

PolygonSoup quad_sphere() {
  PolygonSoup soup;
  const auto at = [](int i, int k) {
    const double theta = pi * i / 12, phi = 2 * pi * k / 24;
    return dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  };
  for (int i = 0; i < 12; ++i)
    for (int k = 0; k < 24; ++k) append(soup, {{at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)}, {{0, 1, 2, 3}}});
  return soup;
}

/// Drawn twice or from both sides, bodies and plates are what they are when drawn once.
TEST(MeshRepair, DoubledSurfacesAreFoundAsAreas) {
  PolygonSoup pyramid{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 2}},
                      {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  const PolygonSoup square = plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  PolygonSoup warped = square;
  warped.points[2].z = 0.1;
  const std::pair<PolygonSoup, PolygonSoup> doubles[] = {{pyramid, reversed(pyramid)},
                                                         {pyramid, rotated(pyramid)},
                                                         {cube(), reversed(remeshed(cube(), 3, 2))},
                                                         {remeshed(cube(), 2, 2), reversed(remeshed(cube(), 3, 3))},
                                                         {quad_sphere(), reversed(quad_sphere())},
                                                         {square, reversed(square)},
                                                         {square, rotated(square)},
                                                         {square, reversed(remeshed(square, 3, 2))},
                                                         {warped, rotated(warped)}};
  for (const auto& [one, other] : doubles)
    for (const glm::dmat3& rotation : {glm::dmat3(1.0), skew_rotation()}) {
      const LoadedMesh once = build(moved(one, rotation)), twice = build(moved(joined(one, other), rotation));
      EXPECT_EQ(twice.report.components, 1u);
      EXPECT_EQ(twice.report.components_closed, once.report.components_closed);
      EXPECT_EQ(twice.report.triangles_internal, 0u);
      EXPECT_EQ(count_by_n(wedges_of(twice)), count_by_n(wedges_of(once)));
      EXPECT_NEAR(area(twice.mesh), area(once.mesh), 1e-12);
    }
}

/// The septum of an open tube has two walls around each border edge as well, but waves reach it.
TEST(MeshRepair, KeepsADoubledSeptumInAnOpenTube) {
  PolygonSoup tube;
  for (const double x : {0.0, 1.0}) {
    PolygonSoup half = box({x, 0, 0}, {x + 1, 1, 1});
    half.polygons.resize(4);  // the four walls along x
    append(tube, half);
  }
  const PolygonSoup septum{{{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}, {{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}}};
  const LoadedMesh loaded = build(joined(tube, septum));
  EXPECT_EQ(loaded.report.triangles_internal, 0u);
  EXPECT_EQ(loaded.report.triangles_duplicate, 2u);
  EXPECT_EQ(loaded.report.triangles_traced, 18u);
}

/// A fin on a cube whose top has edges under the fin's foot, along its whole width or the middle half of it.
TEST(MeshRepair, CubeWithAFinIsClosedAndTheFinOpen) {
  for (const double margin : {0.0, 0.25}) {
    PolygonSoup soup = cube();
    soup.polygons.erase(soup.polygons.begin() + 1);  // the top
    append(soup, remeshed(plate({0, 0, 1}, {1, 0, 0}, {0, 1, 0}), 4, 4));
    append(soup, remeshed(plate({0.5, margin, 1}, {0, 1 - 2 * margin, 0}, {0, 0, 1}), margin == 0.0 ? 4 : 2, 1));
    const LoadedMesh loaded = build(soup);
    EXPECT_EQ(loaded.report.components, 2u);
    EXPECT_EQ(loaded.report.components_closed, 1u);
    EXPECT_EQ(loaded.report.patches, 7u);
    EXPECT_EQ(count_by_n(wedges_of(loaded)), (Count{{0.5, 2}, {1.5, 12}, {2.0, 3}}));
  }
}

TEST(MeshRepair, PlatesWithDifferentSeamsBecomeOne) {
  const LoadedMesh loaded = build(
      joined(remeshed(plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 2, 3), remeshed(plate({1, 0, 0}, {1, 0, 0}, {0, 1, 0}), 1, 4)));
  EXPECT_EQ(loaded.report.t_junctions_split, 5u);  // three vertices on one side of the seam, two on the other
  EXPECT_EQ(loaded.report.components, 1u);
  EXPECT_EQ(loaded.report.patches, 1u);
  EXPECT_NEAR(area(loaded.mesh), 2.0, 1e-15);
  EXPECT_EQ(count_by_n(wedges_of(loaded)), (Count{{2.0, 4}}));
}

TEST(MeshRepair, CubeWithFacesSplitDifferentlyIsClosed) {
  for (const glm::dmat3& rotation : {glm::dmat3(1.0), skew_rotation()}) {
    PolygonSoup soup;
    for (int face = 0; face < 6; ++face)
      append(soup, remeshed({cube().points, {cube().polygons[face]}}, face == 0 ? 1 : 2 * face + 1, face + 2));
    const LoadedMesh loaded = build(moved(soup, rotation));
    EXPECT_GT(loaded.report.t_junctions_split, 0u);
    EXPECT_EQ(loaded.report.components, 1u);
    EXPECT_EQ(loaded.report.components_closed, 1u);
    EXPECT_EQ(loaded.report.open_edges, 0u);
    EXPECT_EQ(loaded.report.patches, 6u);
    EXPECT_EQ(count_by_n(wedges_of(loaded)), (Count{{1.5, 12}}));
  }
}

/// The fin's vertices lie on the box's edge, which is no border: the box is split all the same.
TEST(MeshRepair, FinOnASplitEdgeOfABoxIsJoined) {
  const LoadedMesh loaded = build(joined(cube(), remeshed(plate({1, 0, 1}, {0, 1, 0}, {1, 0, 0}), 3, 1)));
  EXPECT_EQ(count_by_n(wedges_of(loaded)), (Count{{0.5, 1}, {1.5, 11}, {2.0, 3}}));  // and one of n = 1 along the top
}

TEST(MeshRepair, SliversInAPlaneAreKeptAndHarmless) {
  for (const double width : {1e-3, 1e-6}) {  // aspect 10^3 and 10^6
    PolygonSoup soup = remeshed(plate({0, 0, 0}, {1, 0, 0}, {0, 0.5, 0}), 3, 1);
    append(soup, remeshed(plate({0, 0.5, 0}, {1, 0, 0}, {0, width, 0}), 1, 1));
    append(soup, remeshed(plate({0, 0.5 + width, 0}, {1, 0, 0}, {0, 0.5, 0}), 5, 1));
    const LoadedMesh loaded = build(moved(soup, skew_rotation()));
    EXPECT_EQ(loaded.report.triangles_degenerate, 0u);
    EXPECT_EQ(loaded.report.patches, 1u);
    EXPECT_EQ(wedges_of(loaded).size(), 4u);
  }
}

/// Fans over a side with many vertices on it, as exporters write them: flat facets in chains, which all vanish.
TEST(MeshRepair, FlatFacetsLeaveNoCracks) {
  PolygonSoup soup = cube();
  soup.polygons.erase(soup.polygons.begin() + 1);
  PolygonSoup top;
  for (int i = 0; i <= 100; ++i) top.points.push_back({0.01 * i, 0.0, 1.0});
  top.points.insert(top.points.end(), {{1, 1, 1}, {0, 1, 1}});
  for (std::uint32_t i = 2; i < top.points.size(); ++i) top.polygons.push_back({0, i - 1, i});
  append(soup, top);
  for (const glm::dmat3& rotation : {glm::dmat3(1.0), skew_rotation()}) {
    const LoadedMesh loaded = build(moved(soup, rotation));
    EXPECT_EQ(loaded.report.triangles_degenerate, 99u);
    EXPECT_EQ(loaded.report.components, 1u);
    EXPECT_EQ(loaded.report.components_closed, 1u);
    EXPECT_EQ(loaded.report.patches, 6u);
    EXPECT_NEAR(area(loaded.mesh), 6.0, 1e-13);  // two hundred roundings
    EXPECT_EQ(wedges_of(loaded).size(), 12u);
  }
}

TEST(MeshRepair, FlatFacetsBackToBackVanishToo) {
  // Two flat triangles share their long side, each with a vertex of its own on it; the square closes up behind both.
  const PolygonSoup soup{{{0, 0, 0}, {3, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1, 0}},
                         {{0, 2, 4}, {2, 1, 4}, {0, 1, 2}, {0, 3, 1}, {0, 5, 3}, {3, 5, 1}}};
  const LoadedMesh loaded = build(soup);
  EXPECT_EQ(loaded.report.components, 1u);
  EXPECT_NEAR(area(loaded.mesh), 3.0, 1e-15);
  EXPECT_EQ(wedges_of(loaded).size(), 4u);
}

TEST(MeshRepair, SplitsPolygonsThatAreNotConvex) {
  const LoadedMesh ell = build(prism({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, 1.0));
  EXPECT_NEAR(area(ell.mesh), 2 * 5 + 12, 1e-14);
  // A square with a square hole, whose outline passes the bridge to the hole twice.
  const PolygonSoup frame{{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}},
                          {{0, 1, 2, 3, 0, 4, 5, 6, 7, 4}}};
  const LoadedMesh loaded = build(frame);
  EXPECT_NEAR(area(loaded.mesh), 8.0, 1e-15);
  EXPECT_EQ(loaded.report.patches, 1u);
  EXPECT_EQ(count_by_n(wedges_of(loaded)), (Count{{2.0, 8}}));
}

TEST(MeshRepair, CountsPolygonsWithoutThreeCorners) {
  PolygonSoup soup = cube();
  soup.polygons.push_back({0, 1});
  soup.polygons.push_back({2, 2, 3});
  soup.polygons.push_back({});
  const LoadedMesh loaded = build(soup);
  EXPECT_EQ(loaded.report.facets_read, 9u);
  EXPECT_EQ(loaded.report.facets_unusable, 3u);
  EXPECT_EQ(loaded.report.triangles_read, 12u);
}

TEST(MeshRepair, RejectsASurfaceWithoutArea) {
  EXPECT_THROW(build_mesh({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}, 1.0), InputError);
  EXPECT_THROW(build_mesh({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}}, 1.0), InputError);
  EXPECT_THROW(build_mesh({{{0, 0, 0}}, {{0, 0, 0}}}, 1.0), InputError);
  EXPECT_THROW(build_mesh({{{-1e308, 0, 0}, {1e308, 0, 0}, {0, 1e308, 0}}, {{0, 1, 2}}}, 1.0), InputError);
}

TEST(MeshRepair, NotesNameOnlyWhatWasFound) {
  PolygonSoup soup = cube();
  std::reverse(soup.polygons[0].begin(), soup.polygons[0].end());
  const auto notes = build(soup).report.notes();
  ASSERT_EQ(notes.size(), 2u);  // four badly wound edges in the file, two facets turned over
  EXPECT_EQ(notes[0].count, 4u);
  EXPECT_EQ(notes[1].count, 2u);
}

// A gap is told from the border of an open surface by what its border can bound, not by how fine the mesh is.
TEST(MeshRepair, NamesBodiesWithASmallGap) {
  const auto nearly_closed = [](PolygonSoup soup) {
    soup.polygons.pop_back();
    const LoadedMesh loaded = build(soup);
    EXPECT_EQ(loaded.report.components_closed, 0u);
    return loaded.report.components_nearly_closed;
  };
  EXPECT_EQ(nearly_closed(sphere(16)), 1u);  // one triangle of 960 is missing
  EXPECT_EQ(nearly_closed(cube()), 0u);      // one side of six
  EXPECT_EQ(nearly_closed(remeshed(plate(dvec3(0.0), dvec3(1, 0, 0), dvec3(0, 1, 0)), 40, 40)), 0u);
  EXPECT_EQ(build(cube()).report.components_nearly_closed, 0u);
}

}  // namespace
}  // namespace raytube::shapes
