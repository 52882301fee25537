// How large the parts of a target are, how large the faces between its edges, and how round its curved surfaces.
#pragma once

#include <vector>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// Sizes [m], and the area of the surface that has them [m^2].
struct SizedArea {
  double size = 0.0, area = 0.0;
};

struct FeatureSizes {
  double area = 0.0;                  // of the whole surface [m^2]
  std::vector<SizedArea> components;  // diagonals of their bounding boxes
  std::vector<SizedArea> faces;       // of triangles joined by creases flatter than wedges: the same
  std::vector<SizedArea> radii;       // of curvature, the smaller one, of triangles that such creases bend
};

/// Creases of less than `min_wedge_angle` [rad] are tessellation. Curvature is the tensor of the creases' angles about a triangle
/// over its area (Cohen-Steiner and Morvan 2003, with a triangle as the region): 1 / R on regular tessellations of spheres and of
/// cylinders of radius R.
FeatureSizes feature_sizes(const TriangleMesh& mesh, double min_wedge_angle);

}  // namespace raytube
