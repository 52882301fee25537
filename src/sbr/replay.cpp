// Replay of a single tube, bounce by bounce.
#include <fmt/format.h>

#include <cmath>

#include "error.h"
#include "sbr/footprint.h"
#include "sbr/launch.h"
#include "sbr/sbr.h"

namespace raytube {

namespace {

TubeTrace find_cell(const LaunchGrid& grid, const dvec3& mesh_center, double u, double v) {
  const dvec2 to_mesh_origin{glm::dot(mesh_center, grid.u_hat), glm::dot(mesh_center, grid.v_hat)};
  const dvec2 at = dvec2(u, v) - to_mesh_origin - dvec2(grid.u_begin, grid.v_begin);
  const dvec2 extent{grid.columns * grid.du, grid.rows * grid.dv};
  if (grid.cells() == 0) throw InputError("trace: the target has no projected area in this look; choose another --look");
  if (at.x < 0.0 || at.y < 0.0 || at.x > extent.x || at.y > extent.y) {
    const dvec2 low = to_mesh_origin + dvec2(grid.u_begin, grid.v_begin), high = low + extent;
    throw InputError(
        fmt::format("trace: --u {} --v {} lies outside the launch rectangle; use u in {:.6g}..{:.6g} m and v in "
                    "{:.6g}..{:.6g} m",
                    u, v, low.x, high.x, low.y, high.y));
  }
  TubeTrace trace;
  trace.column = std::min(static_cast<std::uint32_t>(at.x / grid.du), grid.columns - 1);
  trace.row = std::min(static_cast<std::uint32_t>(at.y / grid.dv), grid.rows - 1);
  trace.center = to_mesh_origin + dvec2(grid.u_center(trace.column), grid.v_center(trace.row));
  return trace;
}

}  // namespace

TubeTrace trace_tube(const Tracer& tracer, const Look& look, double frequency_hz, const TubeOptions& options, double u,
                     double v) {
  const TriangleMesh& mesh = tracer.mesh();
  const LaunchGrid grid = launch_grid(mesh, look.transmit, wavelength(frequency_hz), options.per_wavelength, options.up);
  TubeTrace trace = find_cell(grid, mesh.center, u, v);
  const SphericalBasis receive = spherical_basis(look.receive);
  Beam beam = incident_beam(grid, spherical_basis(look.transmit), {grid.u_center(trace.column), grid.v_center(trace.row)});
  Ray ray = grid.ray(trace.column, trace.row);
  while (true) {
    Hit hit;
    tracer.closest_hits({&ray, 1}, {&hit, 1});
    trace.end = "left the scene";
    if (!hit) return trace;
    const std::uint32_t patch = mesh.triangle_patch[hit.triangle];
    const bool from_behind = glm::dot(mesh.patches[patch].normal, ray.direction) > 0.0;
    trace.end = "lost: met a closed body from inside";
    if (from_behind && mesh.closed(hit.triangle)) return trace;
    trace.end = "cut at tubes.max_bounces";
    if (static_cast<int>(trace.bounces.size()) == options.max_bounces) return trace;
    const dvec3 point = ray.origin + hit.distance * ray.direction;
    const double path = beam.path + glm::dot(beam.direction, point) + glm::dot(grid.direction, mesh.center);
    beam = footprint(beam, mesh.patches[patch], receive).outgoing;
    ray = {point, beam.direction, patch};
    const dvec3 normal = from_behind ? -mesh.patches[patch].normal : mesh.patches[patch].normal;
    trace.bounces.push_back({hit.triangle, patch, ray.origin, normal, beam.direction, path, beam.field});
  }
}

}  // namespace raytube
