// Polygons -> TriangleMesh: welded, without T-junctions, slivers and duplicates, wound alike, grouped in patches.
//
// Steps, in their order: middle of the bounding box to the origin; polygons to triangles (triangulate); weld; conform (slivers,
// T-junctions, edge_splits); coincident; duplicates; orient (winding), which also finds the components; patches (all in steps.h).
// `distance` is that of welding, weld_fraction of the bounding box's diagonal, unless something else is said.
#pragma once

#include <span>

#include "mesh/model/polygon_soup.h"
#include "mesh/model/triangle_mesh.h"
#include "scene/material.h"

namespace raytube {

/// A mesh as it will be traced, and what was done to it.
struct LoadedMesh {
  TriangleMesh mesh;  // welded, oriented, grouped
  MeshReport report;  // every facet accounted for
};

/// Welds, cleans, orients and groups a soup. `metres_per_unit` scales the file's coordinates. See docs for each rule.
/// `materials` are those the soup's materials count in (none: nothing lets waves through): closed components with a facet that
/// lets waves through have two exposed sides, so they are none of the closed ones of the mesh, though wound outward.
///
/// Throws InputError when nothing with an area is left; `name` is used in its sentence.
LoadedMesh build_mesh(PolygonSoup soup, double metres_per_unit, const std::string& name = "mesh",
                      std::span<const Material> materials = {});

}  // namespace raytube
