#include "solve/target.h"

#include <utility>

#include "mesh/features/enclosed.h"

namespace raytube {

Target::Target(TriangleMesh triangles, const WedgeOptions& how)
    : owned_(std::make_unique<const TriangleMesh>(std::move(triangles))),
      mesh(*owned_),
      options(how),
      tracer(mesh),
      faces(mesh),
      convexity(find_convexity(mesh)),
      wedges(find_wedges(mesh, how.min_wedge_angle)),
      components_enclosed(find_enclosed_components(faces)),
      wedges_enclosed(mark_enclosed(mesh, components_enclosed, wedges)),
      outlines(mesh, wedges, how.min_wedge_angle),
      thin_plate_edges(how.thin_plates ? find_thin_plate_edges(mesh, wedges) : std::vector<ThinPlateEdge>()) {}

}  // namespace raytube
