// Rays of waves over curved surfaces: plain data, for pictures.
#pragma once

#include <vector>

#include "core/field.h"

namespace raytube {

/// What starts a ray: a shadow boundary, from which it runs into the dark, or an edge.
enum class SurfaceRayKind { into_the_dark, from_an_edge };

struct SurfaceRayPoint {
  dvec3 position;
  double arc_length;  // [m] from its start
  double xi;          // Fock's distance from the start, in units of the width of a shadow boundary
  double width;       // of the strip, over that at its start
  double hard, soft;  // |eta J| for unit eta H across the ray, for unit E across it; of edges, along the edge (strip_rays.h)
};

/// One strip of a surface, as a polyline.
struct SurfaceRay {
  SurfaceRayKind kind;
  int order;  // strips one after another, this one included
  std::vector<SurfaceRayPoint> points{};
};

}  // namespace raytube
