// What each facet is made of, through mending, grouping and comparing.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "mesh/features/enclosed.h"
#include "mesh/features/overlaps.h"
#include "mesh/features/symmetry.h"
#include "mesh/model/join.h"
#include "mesh/smooth/smooth.h"
#include "unit/mesh_shapes.h"

namespace raytube::shapes {
namespace {

using ::testing::ElementsAre;

constexpr std::uint32_t absorber = 0, film = 1, metal = no_index;

const std::vector<Material> both{{"absorber", MaterialKind::absorber, 0.0, {}}, {"film", MaterialKind::thin_sheet, 0.0, {}}};

PolygonSoup made_of(PolygonSoup soup, std::uint32_t material) {
  soup.materials.assign(soup.polygons.size(), material);
  return soup;
}

PolygonSoup with_materials(PolygonSoup soup, std::vector<std::uint32_t> materials) {
  soup.materials = std::move(materials);
  return soup;
}

PolygonSoup together(PolygonSoup whole, const PolygonSoup& part) {
  add_polygons(part, whole);
  return whole;
}

LoadedMesh build_both(const PolygonSoup& soup) {
  LoadedMesh loaded = build_mesh(soup, 1.0, "mesh", both);
  expect_consistent(loaded);
  return loaded;
}

std::uint32_t material(const TriangleMesh& mesh, std::uint32_t triangle) { return mesh.patch_of(triangle).material; }

double area_of(const TriangleMesh& mesh, std::uint32_t wanted) {
  double sum = 0.0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (material(mesh, t) == wanted) sum += 0.5 * glm::length(area_vector(mesh.vertices, mesh.triangles[t]));
  return sum;
}

// Sums of a few areas of order one.
constexpr double rounding = 1e-14;

/// The faces of a cube in turn, each of n x n cells.
PolygonSoup cells(int n, const std::array<std::uint32_t, 6>& faces) {
  PolygonSoup soup = remeshed(cube(), n, n);
  for (const std::uint32_t face : faces) soup.materials.insert(soup.materials.end(), std::size_t(2 * n * n), face);
  return soup;
}

/// A unit square of cells in rows, of which each has its material.
PolygonSoup striped(const std::vector<std::uint32_t>& rows) {
  const int n = static_cast<int>(rows.size());
  PolygonSoup soup = remeshed(plate(dvec3(0.0), {1, 0, 0}, {0, 1, 0}), n, n);
  for (const std::uint32_t row : rows) soup.materials.insert(soup.materials.end(), std::size_t(2 * n), row);
  return soup;
}

void expect_same_bytes(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.triangle_patch, b.triangle_patch);
  EXPECT_EQ(a.triangle_component, b.triangle_component);
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t i = 0; i < a.patches.size(); ++i)
    EXPECT_TRUE(a.patches[i].normal == b.patches[i].normal && a.patches[i].offset == b.patches[i].offset);
}

// One plane, cut into many more pieces than there were patches.
TEST(MeshMaterials, APlaneInStripesIsAsManyPatches) {
  constexpr std::uint32_t stripes = 600;
  PolygonSoup soup;
  for (std::uint32_t i = 0; i <= stripes; ++i)
    for (const double y : {0.0, 1.0}) soup.points.emplace_back(0.01 * i, y, 0.0);
  for (std::uint32_t i = 0; i < stripes; ++i) {
    soup.polygons.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
    soup.materials.push_back(i % 2 == 0 ? absorber : metal);
  }
  const TriangleMesh mesh = build_both(soup).mesh;
  EXPECT_EQ(mesh.patches.size(), stripes);
  EXPECT_EQ(std::ranges::count(mesh.patches, absorber, &Patch::material), stripes / 2);
}

TEST(MeshMaterials, OfOneKindTheyChangeNothingElse) {
  for (const PolygonSoup& soup : {sphere(9), remeshed(cube(), 3, 2), moved(cylinder(13), skew_rotation())}) {
    const TriangleMesh bare = build(soup).mesh;
    expect_same_bytes(bare, build(made_of(soup, metal)).mesh);
    expect_same_bytes(bare, build_both(made_of(soup, absorber)).mesh);
    for (const Patch& patch : bare.patches) EXPECT_EQ(patch.material, no_index);
    for (const Patch& patch : build_both(made_of(soup, absorber)).mesh.patches) EXPECT_EQ(patch.material, absorber);
  }
}

TEST(MeshMaterials, PolygonsKeepTheirsWhenCutIntoTriangles) {
  const LoadedMesh loaded = build_both(with_materials(prism({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, 1.0),
                                                      {metal, absorber, metal, metal, metal, metal, metal, absorber}));
  EXPECT_NEAR(area_of(loaded.mesh, absorber), 1.0 + 5.0, 10 * rounding);
  EXPECT_NEAR(area_of(loaded.mesh, metal), area(loaded.mesh) - 6.0, 10 * rounding);
}

// Facets with corners of their own, and between them such as are left out: points, needles and repeated ones.
TEST(MeshMaterials, FacetsKeepTheirsWhenOthersAreLeftOut) {
  const PolygonSoup good = cells(2, {absorber, metal, absorber, metal, metal, film});
  PolygonSoup soup = good;
  soup.polygons.clear();
  soup.materials.clear();
  for (std::size_t i = 0; i < good.polygons.size(); ++i) {
    const auto& [a, b, c] = std::array{good.polygons[i][0], good.polygons[i][1], good.polygons[i][2]};
    const std::uint32_t own = good.materials[i], other = own == absorber ? metal : absorber;
    soup.polygons.insert(soup.polygons.end(), {{a, a, b}, {a, b, c}, {a, b, b, a}, {b, c, a}});
    soup.materials.insert(soup.materials.end(), {other, own, other, own});
  }
  const LoadedMesh loaded = build_both(soup);
  EXPECT_EQ(loaded.report.triangles_duplicate, 48u);
  EXPECT_EQ(loaded.report.duplicates_of_other_material, 0u);
  EXPECT_NEAR(area_of(loaded.mesh, absorber), 2.0, rounding);
  EXPECT_NEAR(area_of(loaded.mesh, film), 1.0, rounding);
  EXPECT_NEAR(area_of(loaded.mesh, metal), 3.0, rounding);
  for (std::uint32_t t = 0; t < loaded.mesh.triangles.size(); ++t) {
    const dvec3& normal = loaded.mesh.patch_of(t).normal;
    const std::uint32_t expected = normal.z == -1.0 || normal.y == -1.0 ? absorber : normal.x == 1.0 ? film : metal;
    EXPECT_EQ(material(loaded.mesh, t), expected);
  }
}

// A unit square beside two halves of one: the long edge is split at the corner that lies on it.
TEST(MeshMaterials, SplitEdgesKeepThem) {
  PolygonSoup soup = made_of(plate(dvec3(0.0), {1, 0, 0}, {0, 1, 0}), absorber);
  add_polygons(made_of(plate({1, 0, 0}, {1, 0, 0}, {0, 0.5, 0}), film), soup);
  add_polygons(plate({1, 0.5, 0}, {1, 0, 0}, {0, 0.5, 0}), soup);
  const LoadedMesh loaded = build_both(soup);
  EXPECT_EQ(loaded.report.t_junctions_split, 1u);
  EXPECT_EQ(loaded.report.triangles_added, 1u);
  EXPECT_EQ(loaded.mesh.components.size(), 1u);
  EXPECT_EQ(loaded.mesh.patches.size(), 3u);
  EXPECT_NEAR(area_of(loaded.mesh, absorber), 1.0, rounding);
  EXPECT_NEAR(area_of(loaded.mesh, film), 0.5, rounding);
  EXPECT_NEAR(area_of(loaded.mesh, metal), 0.5, rounding);
}

// A needle of 1e-8 of the size is no surface; its neighbour closes up behind it and stays what it is.
TEST(MeshMaterials, NeighboursOfANeedleKeepThem) {
  const PolygonSoup soup{{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-8, 0}, {0.5, 1, 0}, {0.5, -1, 0}},
                         {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}, {1, 0, 4}}};
  const LoadedMesh loaded = build_both(with_materials(soup, {film, absorber, absorber, metal}));
  EXPECT_EQ(loaded.report.triangles_degenerate, 1u);
  EXPECT_EQ(area_of(loaded.mesh, film), 0.0);
  EXPECT_NEAR(area_of(loaded.mesh, absorber), 0.5, 2e-8);
  EXPECT_NEAR(area_of(loaded.mesh, metal), 0.5, 2e-8);
}

// The face z = 0 of a cube three times, in both senses: the first one stays, and only what the others lose is said.
TEST(MeshMaterials, OfCoincidentFacetsTheFirstOneStays) {
  const PolygonSoup first = cells(1, {absorber, metal, metal, metal, metal, metal});
  const auto face = [&](bool turned, std::uint32_t material) {
    PolygonSoup soup{first.points, {first.polygons[0], first.polygons[1]}};
    if (turned)
      for (Polygon& polygon : soup.polygons) std::ranges::reverse(polygon);
    return made_of(soup, material);
  };
  for (const bool turned : {false, true}) {
    for (const auto& [material, other] : {std::pair(absorber, 0u), std::pair(metal, 2u), std::pair(film, 2u)}) {
      const LoadedMesh loaded = build_both(together(first, face(turned, material)));
      EXPECT_EQ(loaded.report.triangles_duplicate, 2u);
      EXPECT_EQ(loaded.report.duplicates_of_other_material, other);
      EXPECT_NEAR(area_of(loaded.mesh, absorber), 1.0, rounding);
      EXPECT_NEAR(area_of(loaded.mesh, metal), 5.0, rounding);
    }
  }
  const LoadedMesh loaded = build_both(together(together(first, face(true, film)), face(true, absorber)));
  EXPECT_EQ(loaded.report.triangles_duplicate, 4u);
  EXPECT_EQ(loaded.report.duplicates_of_other_material, 2u);
  EXPECT_EQ(loaded.report.components_closed, 1u);
}

// Nothing reaches the wall between two bodies; through the skin of sheets everything does.
TEST(MeshMaterials, WallsBetweenBodiesGoUnlessWavesReachThem) {
  const PolygonSoup one = box(dvec3(0.0), dvec3(1.0)), two = box({1, 0, 0}, {2, 1, 1});
  const LoadedMesh solid = build_both(together(made_of(one, absorber), two));
  EXPECT_EQ(solid.report.triangles_internal, 4u);
  EXPECT_EQ(solid.report.duplicates_of_other_material, 0u);
  EXPECT_EQ(solid.report.components_closed, 1u);
  EXPECT_NEAR(area_of(solid.mesh, absorber), 5.0, rounding);
  EXPECT_NEAR(area_of(solid.mesh, metal), 5.0, rounding);
  const LoadedMesh radome = build_both(together(two, made_of(one, film)));
  EXPECT_EQ(radome.report.triangles_internal, 0u);
  EXPECT_EQ(radome.report.duplicates_of_other_material, 2u);
  EXPECT_NEAR(area_of(radome.mesh, metal), 6.0, rounding);
  EXPECT_NEAR(area_of(radome.mesh, film), 5.0, rounding);
}

// Cells of stripes 2, 1 and 1 wide: as many patches, exactly in one plane, and no wedge between them even where all creases are.
TEST(MeshMaterials, PatchesEndWhereTheyMeet) {
  const LoadedMesh loaded = build_both(striped({absorber, absorber, metal, absorber}));
  ASSERT_EQ(loaded.mesh.patches.size(), 3u);
  for (const Patch& patch : loaded.mesh.patches) {
    EXPECT_EQ(patch.normal, loaded.mesh.patches[0].normal);
    EXPECT_EQ(patch.offset, loaded.mesh.patches[0].offset);
  }
  EXPECT_NEAR(area_of(loaded.mesh, absorber), 0.75, rounding);
  EXPECT_NEAR(area_of(loaded.mesh, metal), 0.25, rounding);
  for (const double min_degrees : {0.0, 15.0}) EXPECT_EQ(count_by_n(wedges_of(loaded, min_degrees)), (Count{{2.0, 8}}));
}

TEST(MeshMaterials, EdgesOfACubeEndWhereTheyMeet) {
  PolygonSoup soup = moved(cells(2, {metal, metal, metal, metal, metal, metal}), skew_rotation());
  std::fill_n(soup.materials.begin() + 8, 4, absorber);  // half of the second face
  const LoadedMesh loaded = build_both(soup);
  EXPECT_EQ(loaded.mesh.patches.size(), 7u);
  EXPECT_EQ(loaded.report.components_closed, 1u);
  for (const double min_degrees : {0.0, 15.0}) {
    const std::vector<Wedge> wedges = wedges_of(loaded, min_degrees);
    EXPECT_EQ(count_by_n(wedges), (Count{{1.5, 14}}));
    EXPECT_NEAR(total_length(wedges), 12.0, 1e-13);  // 14 roundings of lengths
  }
}

// Wound outward as any closed body, whichever way the file has it; but seen from both sides.
TEST(MeshMaterials, ABodyPartlyOfSheetsIsOpen) {
  for (const bool turned : {false, true}) {
    PolygonSoup soup = with_materials(cube(), {metal, film, metal, metal, absorber, metal});
    if (turned)
      for (Polygon& polygon : soup.polygons) std::ranges::reverse(polygon);
    const LoadedMesh loaded = build_both(soup);
    EXPECT_NEAR(volume(loaded.mesh), 1.0, rounding);
    ASSERT_EQ(loaded.mesh.components.size(), 1u);
    EXPECT_FALSE(loaded.mesh.components[0].closed);
    EXPECT_TRUE(loaded.mesh.components[0].penetrable);
    EXPECT_EQ(loaded.report.components_closed, 0u);
    EXPECT_EQ(loaded.report.components_penetrable, 1u);
    const auto notes = loaded.report.notes();
    ASSERT_EQ(notes.size(), turned ? 2u : 1u);
    EXPECT_EQ(notes.back().what, "parts that are closed, but partly of sheets: seen from both sides");
  }
  EXPECT_EQ(build_both(made_of(cube(), absorber)).report.components_closed, 1u);
  EXPECT_EQ(build_both(made_of(cube(), absorber)).report.components_penetrable, 0u);
}

Overlaps overlaps_of(const PolygonSoup& soup) {
  const LoadedMesh loaded = build_both(soup);
  return overlaps_of_materials(Tracer(loaded.mesh));
}

// A film and a plate of the whole and of a part of its size, apart from it and tilted.
TEST(MeshMaterials, OverlapsAreThoseInOnePlane) {
  const PolygonSoup below = plate(dvec3(0.0), {1, 0, 0}, {0, 1, 0});
  const auto upon = [&](const PolygonSoup& film_soup) {
    return overlaps_of(moved(together(made_of(film_soup, film), below), skew_rotation())).pairs;
  };
  EXPECT_EQ(upon(plate({0.4, 0.2, 0}, {0.1, 0, 0}, {0, 0.1, 0})), 2u);
  EXPECT_EQ(upon(plate({0.4, 0.45, 0}, {0.1, 0, 0}, {0, 0.1, 0})), 3u);
  EXPECT_EQ(upon(plate({0.4, 0.2, 1e-5}, {0.1, 0, 0}, {0, 0.1, 0})), 0u);
  EXPECT_EQ(upon(plate({0.4, 0.2, 0}, {0.1, 0, 0}, {0, 0.1, 0.01})), 0u);
  EXPECT_EQ(upon(plate({0.4, 0.2, -0.1}, {0.1, 0, 0}, {0, 0, 0.3})), 0u);
  EXPECT_EQ(upon(plate({1, 0, 0}, {1, 0, 0}, {0, 1, 0})), 0u);
  EXPECT_EQ(upon(plate({1, 1, 0}, {1, 0, 0}, {0, 1, 0})), 0u);
  EXPECT_EQ(upon(plate({1 + 3e-7, 0.2, 0}, {1, 0, 0}, {0, 0.5, 0})), 0u);  // beside it, but not welded
  EXPECT_EQ(overlaps_of(made_of(together(plate({0.4, 0.2, 0}, {0.1, 0, 0}, {0, 0.1, 0}), below), film)).pairs, 0u);
}

// With the whole outline in common they are duplicates, whatever their diagonals.
TEST(MeshMaterials, OverlapsMayShareCorners) {
  const std::vector<dvec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 2, 0}};
  const auto drawn = [&](const std::vector<Polygon>& films) {
    const PolygonSoup metals{square, {{0, 1, 2}, {0, 2, 3}}};
    return together(made_of(PolygonSoup{square, films}, film), metals);
  };
  const auto pairs = [&](const std::vector<Polygon>& films) { return overlaps_of(drawn(films)).pairs; };
  EXPECT_EQ(pairs({{0, 1, 3}, {1, 2, 3}}), 0u);
  EXPECT_EQ(build_both(drawn({{0, 1, 3}, {1, 2, 3}})).report.duplicates_of_other_material, 2u);
  EXPECT_EQ(pairs({{0, 1, 4}}), 2u);
  EXPECT_EQ(pairs({{2, 3, 4}}), 0u);
  EXPECT_EQ(overlaps_of(striped({film, metal, absorber})).pairs, 0u);
}

TEST(MeshMaterials, OverlapsHaveASideInCommon) {
  const PolygonSoup below = box(dvec3(0.0), {1, 1, 1});
  const auto with = [&](const dvec3& low, const dvec3& high, std::uint32_t material) {
    return overlaps_of(together(below, made_of(box(low, high), material))).pairs;
  };
  EXPECT_EQ(with({0.5, 0.1, 1}, {0.7, 0.2, 2}, absorber), 0u);    // upon one another
  EXPECT_EQ(with({0.5, 0.1, 1}, {0.7, 0.2, 2}, film), 2u);        // waves get in
  EXPECT_EQ(with({0.5, 0.1, 0.5}, {0.7, 0.2, 1}, absorber), 2u);  // both look up
}

TEST(MeshMaterials, AnOverlapHasAnExample) {
  const PolygonSoup below = plate(dvec3(0.0), {1, 0, 0}, {0, 1, 0});
  const LoadedMesh loaded = build_both(together(below, made_of(plate({0.6, 0.2, 0}, {0.1, 0, 0}, {0, 0.1, 0}), film)));
  const auto [first, second] = overlaps_of_materials(Tracer(loaded.mesh)).example;
  EXPECT_EQ(material(loaded.mesh, first), metal);
  EXPECT_EQ(material(loaded.mesh, second), film);
}

TEST(MeshMaterials, WhatLiesBehindSheetsIsNotEnclosed) {
  const PolygonSoup inner = box(dvec3(0.4), dvec3(0.6));
  const auto enclosed = [&](const PolygonSoup& hull) {
    return find_enclosed_components(FaceTree(build_both(together(hull, inner)).mesh));
  };
  EXPECT_THAT(enclosed(cube()), ElementsAre(false, true));
  EXPECT_THAT(enclosed(made_of(cube(), absorber)), ElementsAre(false, true));
  EXPECT_THAT(enclosed(with_materials(cube(), {metal, metal, film, metal, metal, metal})), ElementsAre(false, false));
}

TEST(MeshMaterials, MirrorImagesAreOfTheSame) {
  const auto planes = [](const PolygonSoup& soup) {
    const LoadedMesh loaded = build_both(soup);
    return find_symmetry_planes(loaded.mesh, wedges_of(loaded));
  };
  // Faces at low z, high z, low y, high y, low x, high x.
  EXPECT_THAT(planes(with_materials(cube(), {metal, absorber, metal, metal, metal, metal})), ElementsAre(true, true, false));
  EXPECT_THAT(planes(with_materials(cube(), {metal, metal, metal, metal, film, film})), ElementsAre(true, true, true));
  EXPECT_THAT(planes(striped({absorber, metal})), ElementsAre(false, true, false));
  EXPECT_THAT(planes(striped({absorber, metal, absorber})), ElementsAre(true, true, false));
  // Layers count from the side of the normal, which a metal plate has none of.
  EXPECT_THAT(planes(striped({metal, metal})), ElementsAre(true, true, true));
  EXPECT_THAT(planes(striped({film, film})), ElementsAre(true, true, false));
}

TEST(MeshMaterials, JoinedMeshesKeepThem) {
  const std::vector<TriangleMesh> parts{build_both(made_of(cube(), absorber)).mesh,
                                        build_both(moved(cube(), glm::dmat3(1.0), {5, 0, 0})).mesh};
  const JoinedMesh joined = join_meshes(parts);
  for (std::uint32_t t = 0; t < joined.mesh.triangles.size(); ++t)
    EXPECT_EQ(material(joined.mesh, t), joined.triangle_part[t] == 0 ? absorber : metal);
}

/// A closed cylinder of radius 1 about z, walls and caps cut at x = 0: what is made of `right` has x > 0.
PolygonSoup halved_cylinder(std::uint32_t right) {
  std::vector<dvec2> outline;
  for (int i = 0; i < 72; ++i) outline.push_back({std::sin(5.0 * i * degree), -std::cos(5.0 * i * degree)});
  PolygonSoup soup = prism(outline, 2.0);
  soup.polygons.resize(72);
  for (const std::uint32_t first : {0u, 72u})
    for (const std::uint32_t half : {0u, 36u}) {
      Polygon cap;
      for (std::uint32_t i = 0; i <= 36; ++i) cap.push_back(first + (half + i) % 72);
      if (first == 0) std::ranges::reverse(cap);
      soup.polygons.push_back(cap);
    }
  for (int i = 0; i < 72; ++i) soup.materials.push_back(i < 36 ? right : metal);
  soup.materials.insert(soup.materials.end(), {right, metal, right, metal});
  return soup;
}

// The surface stays the cylinder it is, to the bit; its two halves are regions that end where they meet.
TEST(MeshMaterials, CurvedSurfacesKeepTheirShapeAndEndWhereTheyMeet) {
  const TriangleMesh bare = build_both(halved_cylinder(metal)).mesh, halved = build_both(halved_cylinder(absorber)).mesh;
  const SmoothSurfaces one(bare, 15.0 * degree, 1.0), two(halved, 15.0 * degree, 1.0);
  EXPECT_EQ(one.facets(), 144u);
  EXPECT_EQ(two.facets(), 144u);
  EXPECT_EQ(one.rise(), two.rise());
  std::map<std::uint32_t, std::set<std::uint32_t>> materials;
  int ends = 0;
  for (std::uint32_t t = 0; t < halved.triangles.size(); ++t) {
    EXPECT_EQ(one.region(t) == no_index, two.region(t) == no_index);
    if (two.region(t) == no_index) continue;
    materials[two.region(t)].insert(material(halved, t));
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(one.bend(t, c), two.bend(t, c));
      ends += two.on_boundary(t, c) && !one.on_boundary(t, c) ? 1 : 0;
    }
  }
  EXPECT_EQ(materials.size(), 2u);
  for (const auto& [region, found] : materials) EXPECT_EQ(found.size(), 1u);
  EXPECT_EQ(ends, 4);  // two straight lines, from two sides each
}

// A panel 3 wide that runs into a fillet of facets 0.1 wide; its last 0.1 is of something else, and flat like the rest of it.
TEST(MeshMaterials, AStripOfAPanelIsPartOfThePanel) {
  std::vector<dvec2> profile{{-3.0, 0.0}, {-0.1, 0.0}, {0.0, 0.0}};
  for (int i = 0; i < 6; ++i) {
    const double slope = -(2.5 + 5.0 * i) * degree;
    profile.push_back(profile.back() + 0.1 * dvec2(std::cos(slope), std::sin(slope)));
  }
  PolygonSoup soup;
  for (const dvec2& p : profile) soup.points.insert(soup.points.end(), {dvec3(p.x, -1.0, p.y), dvec3(p.x, 1.0, p.y)});
  for (std::uint32_t i = 0; i + 1 < profile.size(); ++i) soup.polygons.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  soup.materials = {metal, absorber, metal, metal, metal, metal, metal, metal};
  const LoadedMesh loaded = build_both(soup);
  const SmoothSurfaces smooth(loaded.mesh, 15.0 * degree, 1.0);
  EXPECT_EQ(smooth.facets(), 12u);
  for (std::uint32_t t = 0; t < loaded.mesh.triangles.size(); ++t) {
    const bool flat = std::abs(loaded.mesh.patch_of(t).normal.z) > 1.0 - 1e-12;
    EXPECT_EQ(smooth.region(t) == no_index, flat);
  }
}

}  // namespace
}  // namespace raytube::shapes
