#include "plan/target.h"

#include <tbb/parallel_invoke.h>

#include <optional>
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

SurfaceFeatures::SurfaceFeatures(const TriangleMesh& mesh, const WedgeOptions& options)
    : faces(mesh),
      convexity(find_convexity(mesh)),
      wedges(find_wedges(mesh, options.min_wedge_angle)),
      components_enclosed(find_enclosed_components(faces)),
      wedges_enclosed(mark_enclosed(mesh, components_enclosed, wedges)),
      outlines(mesh, wedges, options.min_wedge_angle),
      thin_plate_edges(options.thin_plates ? find_thin_plate_edges(mesh, wedges) : std::vector<ThinPlateEdge>()) {}

// Rays and features are made beside one another.
struct Target::Made {
  Made(TriangleMesh&& triangles, const WedgeOptions& how) : options(how), mesh(with_bends(std::move(triangles), options)) {
    tbb::parallel_invoke([&] { tracer.emplace(*mesh); }, [&] { features.emplace(*mesh, options); });
  }

  WedgeOptions options;
  std::unique_ptr<const TriangleMesh> mesh;
  std::optional<Tracer> tracer;
  std::optional<SurfaceFeatures> features;
};

Target::Target(TriangleMesh triangles, const WedgeOptions& how) : Target(Made(std::move(triangles), beyond_rounding(how))) {}

Target::Target(Made&& made)
    : SurfaceFeatures(std::move(*made.features)),
      owned_(std::move(made.mesh)),
      mesh(*owned_),
      options(made.options),
      tracer(std::move(*made.tracer)) {}

}  // namespace raytube
