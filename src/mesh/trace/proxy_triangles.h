// Conservative proxy triangles: what a tracer in single precision is given for the mesh, so that it never overlooks a surface
// that a ray meets.
#pragma once

#include <vector>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// Triangles that cover those of a mesh with a margin on all sides: a ray that meets the mesh meets one of these at about the
/// same point even if all of them are moved by a twentieth of the margin. The first ones are the mesh's own, in patches made
/// wider, each patch with vertices of its own; then come strips across the edges where that is not enough.
struct ProxyTriangles {
  std::vector<dvec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> source;  // the triangle of the mesh that each is, or stands for
  std::vector<double> moved;  // of each triangle of the mesh, how far a corner of it was moved [m]; infinite for rectangles
};

/// For rays whose hits single precision finds to within a twentieth of `margin` [m].
ProxyTriangles proxy_triangles(const TriangleMesh& mesh, double margin);

}  // namespace raytube
