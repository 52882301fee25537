// Thin plates of coated metal: which of them end in half planes.
#include <algorithm>

#include "mesh/features/outlines.h"
#include "plan/material_edges.h"
#include "unit/mesh_shapes.h"

namespace raytube::shapes {
namespace {

PolygonSoup thin_plate(double thickness) { return box(dvec3(0.0), dvec3(3.0, 2.0, thickness)); }

std::vector<Wedge> half_planes_of(const std::vector<Wedge>& wedges) {
  std::vector<Wedge> found;
  for (const Wedge& wedge : wedges)
    if (wedge.thickness() > 0.0) found.push_back(wedge);
  return found;
}

Material coat_of(double depth) { return {"coat", MaterialKind::coated, 0.0, {{{{4.0, -0.1}, depth}}}}; }

/// A plate of this thickness with the material on both of its sides, or all round.
std::vector<ThinPlateEdge> edges_of_covered(double whole, const Material& material, bool all_round, bool coats_count = true) {
  PolygonSoup soup = thin_plate(whole);
  soup.materials.assign(soup.polygons.size(), all_round ? 0 : no_index);
  soup.materials[0] = soup.materials[1] = 0;
  const std::vector<Material> materials{material};
  const LoadedMesh loaded = build_mesh(soup, 1.0, "test", materials);
  return metal_plate_edges(find_thin_plate_edges(loaded.mesh, wedges_of(loaded)), materials, coats_count);
}

TEST(MetalPlates, OfCoatedPlatesTheMetalHasToBeThin) {
  const auto thin = [](double whole, double coat, bool all_round, bool coats_count = true) {
    return count_thin(edges_of_covered(whole, coat_of(coat), all_round, coats_count), speed_of_light);  // limit 0.1
  };
  for (const bool all_round : {false, true}) {
    EXPECT_EQ(thin(0.15, 0.03, all_round), 4u);         // metal 0.09
    EXPECT_EQ(thin(0.15, 0.02, all_round), 0u);         // metal 0.11
    EXPECT_EQ(thin(0.25, 0.09, all_round), 0u);         // metal 0.07, but half of it all is 0.125
    EXPECT_EQ(thin(0.05, 0.01, all_round, false), 0u);  // coats do not count
  }
  const Material rough{"rough", MaterialKind::conductor, 0.01, {}};
  EXPECT_EQ(edges_of_covered(0.05, rough, true).size(), 4u);
}

TEST(MetalPlates, OtherThanCoatedMetalStaysAsItIs) {
  const std::vector<std::vector<Layer>> layers{{{{4.0, -0.1}, 0.01}}};
  for (const MaterialKind kind : {MaterialKind::absorber, MaterialKind::half_space, MaterialKind::solid, MaterialKind::sheet})
    for (const bool all_round : {false, true})
      EXPECT_TRUE(edges_of_covered(0.05, {"other", kind, 0.0, layers}, all_round).empty());
}

TEST(MetalPlates, ABarePlateWithCoatedBordersStaysAsItIs) {
  PolygonSoup soup = thin_plate(0.05);
  soup.materials = {no_index, no_index, 0, 0, 0, 0};
  const std::vector<Material> materials{coat_of(0.01)};
  const LoadedMesh loaded = build_mesh(soup, 1.0, "test", materials);
  const auto edges = find_thin_plate_edges(loaded.mesh, wedges_of(loaded));
  EXPECT_EQ(edges.size(), 4u);
  EXPECT_TRUE(metal_plate_edges(edges, materials, true).empty());
}

/// Currents of conductors end at a coated rim, those of coats do not.
TEST(MetalPlates, HalfPlanesOfCoatedPlatesStandInTheOutlines) {
  PolygonSoup soup = thin_plate(0.05);
  soup.materials.assign(soup.polygons.size(), no_index);
  soup.materials[1] = 0;
  const std::vector<Material> materials{coat_of(0.01)};
  const LoadedMesh loaded = build_mesh(soup, 1.0, "test", materials);
  const std::vector<Wedge> sharp = wedges_of(loaded);
  const auto edges = metal_plate_edges(find_thin_plate_edges(loaded.mesh, sharp), materials, true);
  const std::vector<Wedge> wedges = merge_thin_plate_edges(sharp, edges, 0.1), half_planes = half_planes_of(wedges);
  ASSERT_EQ(half_planes.size(), 4u);
  const Outlines outlines(loaded.mesh, wedges, 15.0 * degree);
  for (const WedgeFace& side : half_planes[0].faces)
    for (const OutlineEdge& edge : outlines.around(side)) {
      ASSERT_NE(edge.any_wedge, no_index);
      EXPECT_GT(wedges[edge.any_wedge].thickness(), 0.0);
      EXPECT_EQ(wedges[edge.any_wedge].faces[edge.wedge_face].patch, side.patch);
      EXPECT_EQ(edge.wedge, no_index);
    }
}

}  // namespace
}  // namespace raytube::shapes
