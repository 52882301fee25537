// One parser for each mesh file format, over the file's bytes. CGAL 5.5 reads these formats too, but loses corners separated
// by tabs, accepts indices out of range and crashes on some headers; OpenMesh 9 rounds every coordinate to single precision, and
// so does assimp 5.2, which also takes quantized numbers of glTF for floats, drops the unit and the names of 3MF, and knows no
// Gmsh.
#pragma once

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

}  // namespace raytube
