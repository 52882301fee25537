#include "plan/target.h"

#include <utility>

#include "mesh/features/enclosed.h"
#include "mesh/smooth/bends.h"

namespace raytube {

namespace {

// Bodies of 24 sides have creases of 15 degrees to the rounding of coordinates: some above the threshold, some below, a mixture
// of edges and curvature.
constexpr double rounding_of_angles = 1e-3;

WedgeOptions beyond_rounding(WedgeOptions options) {
  options.min_wedge_angle *= 1.0 + rounding_of_angles;
  return options;
}

std::unique_ptr<const TriangleMesh> with_bends(TriangleMesh&& mesh, const WedgeOptions& options) {
  mesh.bends = find_bends(mesh, options.min_wedge_angle);
  return std::make_unique<const TriangleMesh>(std::move(mesh));
}

}  // namespace

Target::Target(TriangleMesh triangles, const WedgeOptions& how)
    : owned_(with_bends(std::move(triangles), beyond_rounding(how))),
      mesh(*owned_),
      options(beyond_rounding(how)),
      tracer(mesh),
      faces(mesh),
      convexity(find_convexity(mesh)),
      wedges(find_wedges(mesh, options.min_wedge_angle)),
      components_enclosed(find_enclosed_components(faces)),
      wedges_enclosed(mark_enclosed(mesh, components_enclosed, wedges)),
      outlines(mesh, wedges, options.min_wedge_angle),
      thin_plate_edges(how.thin_plates ? find_thin_plate_edges(mesh, wedges) : std::vector<ThinPlateEdge>()) {}

}  // namespace raytube
