#include "plan/target.h"

#include <utility>

#include "mesh/features/enclosed.h"

namespace raytube {

namespace {

// Bodies of 24 sides have creases of 15 degrees to the rounding of coordinates: some above the threshold, some below, a mixture of
// edges and curvature.
constexpr double rounding_of_angles = 1e-3;

WedgeOptions beyond_rounding(WedgeOptions options) {
  options.min_wedge_angle *= 1.0 + rounding_of_angles;
  return options;
}

}  // namespace

Target::Target(TriangleMesh triangles, const WedgeOptions& how)
    : owned_(std::make_unique<const TriangleMesh>(std::move(triangles))),
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
