// The target of a case: all its mesh files, with their materials.
#pragma once

#include "case/data/case.h"
#include "mesh/load.h"

namespace raytube {

/// The files as the user is told of them.
std::string mesh_names(const Case& c);

/// Gives every polygon the material that the case has for it; those of a perfect conductor alone get none. Throws InputError for
/// a part or a facet that is not there, and for a polygon that goes by names of different materials.
void assign_materials(PolygonSoup& soup, const Case& c);

/// Puts what touches the ground of a case, but for rounding, on it. Throws InputError for a target that reaches below.
void stand_on_ground(PolygonSoup& soup, const Case& c);

/// Below the target of a case over perfect ground its mirror image, as a part of it; of others nothing. Throws InputError for a
/// target that reaches below the ground of the case.
void add_mirror_image(PolygonSoup& soup, const Case& c);

/// Reads the files and assigns the materials. With `named` polygons keep the name of their file where there are several. Throws
/// InputError.
PolygonSoup read_target(const Case& c, bool named = false);

/// The mesh of these polygons, with the mirror image where the case has one; `name` is used in sentences about it. Throws
/// InputError.
LoadedMesh build_target(PolygonSoup soup, const Case& c, const std::string& name, bool named = false);

/// Reads the files, assigns the materials and builds the mesh. With `named`, triangles keep their parts' names, that of their
/// file among them where there are several. Throws InputError.
LoadedMesh load_target(const Case& c, bool named = false);

}  // namespace raytube
