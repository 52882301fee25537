// A mesh file as polygons. One parser for each format stands in a file of its own (formats.h).
#pragma once

#include <filesystem>

#include "mesh/model/polygon_soup.h"

namespace raytube {

/// Reads STL (ASCII, binary), OBJ, PLY, OFF, Gmsh (.msh), glTF (.gltf, .glb) or 3MF, chosen by the file name's ending; with .gz
/// behind that, one compressed with gzip. Keeps every facet. Throws InputError: unreadable, something else than the ending says,
/// unknown format, no facets, corner index out of range, coordinate not finite.
PolygonSoup read_polygon_soup(const std::filesystem::path& file);

/// The same, of a file whose unit is to be that long. Throws InputError, too, if the file itself states another one (3MF in its
/// head; glTF is in metres).
PolygonSoup read_polygon_soup(const std::filesystem::path& file, double metres_per_unit);

}  // namespace raytube
