// What all looks at the curved surfaces of a target share.
#pragma once

#include "mesh/features/curvature_field.h"
#include "mesh/model/edge_table.h"
#include "mesh/trace/tracer.h"

namespace raytube {

struct CurvedTarget {
  /// Keeps references to both.
  CurvedTarget(const Tracer& a_tracer, const SmoothSurfaces& some_surfaces)
      : tracer(a_tracer),
        surfaces(some_surfaces),
        edges(tracer.mesh().triangles, tracer.mesh().vertices.size()),
        curvatures(tracer.mesh(), surfaces) {}

  const Tracer& tracer;
  const SmoothSurfaces& surfaces;
  const EdgeTable edges;
  const CurvatureField curvatures;
};

}  // namespace raytube
