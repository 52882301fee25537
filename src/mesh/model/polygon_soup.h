// Polygons of a mesh before anything is mended.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/model/part_names.h"
#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// A length of one mesh unit: as target.unit calls it, and in metres.
struct StatedUnit {
  std::string_view name;  // "mm"
  double metres;          // 1e-3
};

/// Polygons as they stand in the file, in file units, in double precision: polygon i is the file's facet i + 1.
struct PolygonSoup {
  std::vector<dvec3> points;                         // in units of the file
  std::vector<std::vector<std::uint32_t>> polygons;  // corners, as indices in `points`
  std::uint64_t free_forms = 0;                      // curves and surfaces beside them that are no polygons (OBJ)
  /// OBJ: groups (g), object (o) and material (usemtl); ASCII STL: solid; Gmsh: physical groups; glTF: nodes, mesh and material;
  /// 3MF: objects. Other formats have none.
  PartNames names{};
  std::vector<std::uint32_t> materials{};              // of each polygon, as Patch::material; empty: all are perfect conductors
  std::vector<std::uint32_t> parts{};                  // of each polygon, among part_names; empty: not wanted
  std::vector<std::string> part_names{};               // what polygons go by
  std::optional<StatedUnit> stated_unit{};             // what the file itself says, if it says any
  std::vector<std::filesystem::path> further_files{};  // that the file named and that were read with it (glTF)
  int digits = 0;                                      // most digits of a coordinate of a text file; 0: binary
  std::optional<double> step{};                        // between neighbouring coordinates, in units of the file (coordinate_step)
  std::vector<std::string> remarks{};                  // sentences: what was left out as no surface, what to know of the file
};

/// Gives every polygon a further name, as that of the file they are from.
void add_name(PolygonSoup& soup, const std::string& name);

/// Numbers the parts: polygons that go by the same names are one, called by all of them.
void number_parts(PolygonSoup& soup);

/// Several files as one target: appends the polygons of `part` to those of `whole`, with their names and materials. Nothing is
/// welded yet. Both are in the same unit.
void add_polygons(const PolygonSoup& part, PolygonSoup& whole);

}  // namespace raytube
