// The smooth pieces of a mesh, one by one.
#pragma once

#include <vector>

#include "mesh/smooth/smooth.h"

namespace raytube {

struct SmoothPiece {
  std::size_t facets = 0;
  double rise = 0.0;  // of the surface over its facets, the most [m]
};

/// The largest first; of those as large, in order of their first triangles.
std::vector<SmoothPiece> smooth_pieces(const TriangleMesh& mesh, const SmoothSurfaces& surfaces);

}  // namespace raytube
