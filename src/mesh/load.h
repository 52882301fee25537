// Mesh file -> TriangleMesh.
#pragma once

#include <filesystem>

#include "mesh/triangle_mesh.h"

namespace raytube {

/// Polygons as they stand in the file, in file units, in double precision.
struct PolygonSoup {
  std::vector<dvec3> points;
  std::vector<std::vector<std::uint32_t>> polygons;
  std::uint64_t free_forms = 0;  // curves and surfaces beside them that are no polygons (OBJ)
};

/// Reads STL (ASCII, binary), OBJ, PLY or OFF, chosen by the file name's ending. Keeps every facet.
/// Throws InputError: unreadable, unknown format, no facets, corner index out of range, coordinate not finite.
PolygonSoup read_polygon_soup(const std::filesystem::path& file);

struct LoadedMesh {
  TriangleMesh mesh;
  MeshReport report;
};

/// Welds, cleans, orients and groups a soup. `metres_per_unit` scales the file's coordinates. See docs for each rule.
/// Throws InputError when nothing with an area is left; `name` is used in its sentence.
LoadedMesh build_mesh(PolygonSoup soup, double metres_per_unit, const std::string& name = "mesh");

/// read_polygon_soup, then build_mesh.
LoadedMesh load_mesh(const std::filesystem::path& file, double metres_per_unit);

}  // namespace raytube
