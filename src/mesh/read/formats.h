// One parser for each mesh file format, over the file's bytes. CGAL 5.5 reads these formats too, but loses corners separated
// by tabs, accepts indices out of range and crashes on some headers; OpenMesh 9 rounds every coordinate to single precision, and
// so does assimp 5.2, which also takes quantized numbers of glTF for floats, drops the unit and the names of 3MF, and knows no
// Gmsh.
#pragma once

#include <glm/mat4x4.hpp>

#include "mesh/files/mesh_file.h"
#include "mesh/model/polygon_soup.h"

namespace raytube {

/// Each throws InputError with the line or facet and the remedy if the file is not of its format.
PolygonSoup parse_stl(const MeshFile& file);
PolygonSoup parse_obj(const MeshFile& file);
PolygonSoup parse_ply(const MeshFile& file);
PolygonSoup parse_off(const MeshFile& file);
PolygonSoup parse_gmsh(const MeshFile& file);
PolygonSoup parse_gltf(const MeshFile& file);
PolygonSoup parse_3mf(const MeshFile& file);

using MeshParser = PolygonSoup (*)(const MeshFile&);

/// What `parse` finds in the file, once checked for what every format must satisfy. Throws InputError.
PolygonSoup read_polygon_soup(const MeshFile& file, MeshParser parse);

/// The step between neighbouring coordinates where they are largest, as the points tell: that of single precision if all of them
/// are numbers of it, in text too, and that of the digits of a text file (0: binary). 0 for numbers that are exact as far as one
/// can tell: of double precision, or round ones.
double coordinate_step(std::span<const dvec3> points, int digits);

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Appends a part of a file at a place: its vertices moved, in double, and its triangles by these names. A mirrored part is wound
/// the other way, so that its outside stays outside. `bytes` is the size of the file with those it names. Throws InputError if a
/// corner is none of the points, or if more comes of the file than any target has.
void add_instance(const MeshFile& file, std::uintmax_t bytes, const std::vector<glm::dvec3>& points, const Triangles& triangles,
                  const glm::dmat4& place, const std::vector<std::string>& names, PolygonSoup& soup);

}  // namespace raytube
