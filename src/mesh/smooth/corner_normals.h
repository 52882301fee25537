// Normals of the smooth surface behind a tessellation, at the corners of its facets.
#pragma once

#include <vector>

#include "mesh/smooth/creases.h"

namespace raytube {

/// Corners of triangles that share a vertex and hang together without a wedge share a normal: the weighted mean that is exact for
/// the vertices of a sphere (Max 1999, Weights for computing vertex normals from facet normals). Where a facet is much wider than
/// all that lies across one of its creases (a panel that runs into a fillet, the wall of a cylinder into a dome), such facets
/// alone give the normals along that crease: the surface leaves them along their planes.
struct CornerNormals {
  CornerNormals(const TriangleMesh& mesh, const Creases& creases);

  std::vector<std::uint32_t> group;  // of each corner, three a triangle: its number in what follows
  std::vector<dvec3> normals;        // unit
  std::vector<bool> one_sided;       // the facets that give it end at the vertex, and none of them leads
  std::vector<bool> is_plane;        // [plane] the normals at its corners are its own
};

}  // namespace raytube
