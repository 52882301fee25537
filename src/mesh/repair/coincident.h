// Faces that lie on one another and are cut into different triangles.
#pragma once

#include "mesh/model/edge_table.h"
#include "mesh/repair/facets.h"

namespace raytube {

/// Gives coincident faces the same triangles, so that they are doubles of one another triangle by triangle: surfaces drawn from
/// both sides whose copies have other diagonals or are subdivided otherwise, and walls between bodies that touch. A face is a set
/// of triangles in one plane around which others meet or the plane ends; two coincide if their outlines do. Polygons that are
/// somewhat warped count as well, if they have the same corners. Faces that overlap in part stay as they are, and so does a
/// surface that runs back along itself, as both walls of a closed slit.
/// `edges` are those of the facets. Fills triangles_added and t_junctions_split of the report.
void align_coincident_faces(std::span<const dvec3> vertices, const EdgeTable& edges, double distance, Facets& facets,
                            MeshReport& report);

}  // namespace raytube
