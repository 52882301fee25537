// Mesh file -> TriangleMesh.
#pragma once

#include <filesystem>
#include <span>

#include "mesh/model/part_names.h"
#include "mesh/model/triangle_mesh.h"
#include "scene/material.h"

namespace raytube {

/// Polygons as they stand in the file, in file units, in double precision: polygon i is the file's facet i + 1.
struct PolygonSoup {
  std::vector<dvec3> points;
  std::vector<std::vector<std::uint32_t>> polygons;
  std::uint64_t free_forms = 0;  // curves and surfaces beside them that are no polygons (OBJ)
  /// OBJ: groups (g), object (o) and material (usemtl); ASCII STL: solid. Other formats have none.
  PartNames names{};
  std::vector<std::uint32_t> materials{};  // of each polygon, as Patch::material; empty: all are perfect conductors
};

/// Reads STL (ASCII, binary), OBJ, PLY or OFF, chosen by the file name's ending. Keeps every facet.
/// Throws InputError: unreadable, unknown format, no facets, corner index out of range, coordinate not finite.
PolygonSoup read_polygon_soup(const std::filesystem::path& file);

/// A further name of every polygon, as that of the file they are from.
void add_name(PolygonSoup& soup, const std::string& name);

/// Several files as one target: the polygons of `part`, which come after those of `whole`, with their names and materials.
/// Nothing is welded yet. Both are in the same unit.
void add_polygons(const PolygonSoup& part, PolygonSoup& whole);

struct LoadedMesh {
  TriangleMesh mesh;
  MeshReport report;
};

/// Welds, cleans, orients and groups a soup. `metres_per_unit` scales the file's coordinates. See docs for each rule.
/// `materials` are those the soup's materials count in (none: nothing lets waves through): closed components with a facet that
/// lets waves through have two exposed sides, so they are none of the closed ones of the mesh, though wound outward.
///
/// Throws InputError when nothing with an area is left; `name` is used in its sentence.
LoadedMesh build_mesh(PolygonSoup soup, double metres_per_unit, const std::string& name = "mesh",
                      std::span<const Material> materials = {});

/// read_polygon_soup, then build_mesh.
LoadedMesh load_mesh(const std::filesystem::path& file, double metres_per_unit);

}  // namespace raytube
