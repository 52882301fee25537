#include "sbr/replay.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/error.h"
#include "sbr/beams/footprint.h"
#include "sbr/beams/spherical_look.h"
#include "sbr/launch/launch.h"

namespace raytube {

namespace {

TubeTrace find_cell(const LaunchGrid& grid, const dvec3& mesh_center, const dvec2& from_mesh_origin) {
  const dvec2 to_mesh_origin = -launch_coordinates(incident_beam(grid, {}, dvec2(0.0)), -mesh_center);
  const dvec2 at = from_mesh_origin - to_mesh_origin - dvec2(grid.u_begin, grid.v_begin);
  const dvec2 extent{grid.columns * grid.du, grid.rows * grid.dv};
  if (grid.cells() == 0) throw InputError("trace: the target has no projected area in this look; choose another --look");
  if (at.x < 0.0 || at.y < 0.0 || at.x > extent.x || at.y > extent.y) {
    const dvec2 low = to_mesh_origin + dvec2(grid.u_begin, grid.v_begin), high = low + extent;
    throw InputError(
        fmt::format("trace: --u {} --v {} lies outside the launch rectangle; use u in {:.6g}..{:.6g} m and v in "
                    "{:.6g}..{:.6g} m",
                    from_mesh_origin.x, from_mesh_origin.y, low.x, high.x, low.y, high.y));
  }
  TubeTrace trace;
  trace.column = std::min(static_cast<std::uint32_t>(at.x / grid.du), grid.columns - 1);
  trace.row = std::min(static_cast<std::uint32_t>(at.y / grid.dv), grid.rows - 1);
  trace.center = to_mesh_origin + dvec2(grid.u_center(trace.column), grid.v_center(trace.row));
  return trace;
}

// The wave of a tube from surface to surface.
class ReplayedWave {
 public:
  ReplayedWave(const LaunchGrid& grid, const Look& look, const ReplayScene& scene, std::span<const double> wavenumber,
               const dvec2& at)
      : mesh_(scene.tracer.mesh()),
        surfaces_{scene.materials, wavenumber},
        receive_(spherical_basis(look.receive)),
        to_origin_(glm::dot(grid.direction, mesh_.center)),
        beam_(incident_beam(grid, spherical_basis(look.transmit), at)) {
    if (look.far()) return;
    antennas_.emplace(look, scene.radar, mesh_.center);
    spherical_.emplace(*antennas_, beam_, std::span<const double>(&any_wavenumber, 1), 1.0);
  }

  bool from_behind(std::uint32_t patch) const { return facing(beam_, mesh_.patches[patch]) > 0.0; }

  // What leaves the surface at a point.
  TubeBounce reflect(std::uint32_t triangle, const dvec3& point) {
    const std::uint32_t patch = mesh_.triangle_patch[triangle];
    const Patch& plane = mesh_.patches[patch];
    const dvec3 normal = from_behind(patch) ? -plane.normal : plane.normal;
    if (!spherical_) {
      const double path = beam_.path + glm::dot(beam_.direction, point) + to_origin_;
      const bool goes_on = scatter(plane);
      return {triangle, patch, point, normal, beam_.direction, path, field(), goes_on};
    }
    beam_ = reflected_spherical(beam_, plane);
    const AntennaRay leaving = spherical_->wave(beam_, point);
    return {
        triangle, patch, point, normal, leaving.direction, leaving.path, {ComplexVector{leaving.field[0]}, {leaving.field[1]}}};
  }

  bool is_lit() const { return !beam_.spectrum || amplitude(spectrum_) > least_amplitude; }

 private:
  static constexpr double any_wavenumber = 1.0;

  // The reflected beam; true if another one goes on behind the plane.
  bool scatter(const Patch& plane) {
    const bool spectral = beam_.spectrum || plane.material != no_index;
    LeavingWaves waves = spectral ? leaving_waves(surfaces_, beam_, false, plane, receive_) : LeavingWaves{};
    beam_ = footprint(beam_, plane, receive_).outgoing;
    spectrum_ = std::move(waves.reflected);
    if (spectral) beam_.spectrum = &spectrum_;
    return amplitude(waves.transmitted) > least_amplitude;
  }

  std::array<ComplexVector, 2> field() const {
    if (beam_.spectrum) return spectrum_.front().field;
    return {ComplexVector{beam_.field[0]}, {beam_.field[1]}};
  }

  const TriangleMesh& mesh_;
  SpectralSurfaces surfaces_;
  SphericalBasis receive_;
  double to_origin_;
  Beam beam_;
  Spectrum spectrum_;  // the beam's
  std::optional<AntennaPair> antennas_;
  std::optional<SphericalLook> spherical_;
};

}  // namespace

TubeTrace trace_tube(const ReplayScene& scene, const Look& look, double frequency_hz, const TubeOptions& options,
                     const dvec2& at) {
  if (!look.far() && !scene.materials.empty())
    throw InputError("trace: antennas at a finite distance know perfect conductors only; remove [radar] or the materials");
  const TriangleMesh& mesh = scene.tracer.mesh();
  const double k = wavenumber(frequency_hz);
  const LaunchGrid grid = grid_of_look(mesh, look, wavelength(frequency_hz), first_density(options), options.up);
  TubeTrace trace = find_cell(grid, mesh.center, at);
  ReplayedWave wave(grid, look, scene, {&k, 1}, {grid.u_center(trace.column), grid.v_center(trace.row)});
  Ray ray = grid.ray(trace.column, trace.row);
  trace.direction = ray.direction;
  while (true) {
    Hit hit;
    scene.tracer.closest_hits({&ray, 1}, {&hit, 1});
    trace.end = "left the scene";
    if (!hit) return trace;
    trace.end = "lost: met a closed body from inside";
    if (wave.from_behind(mesh.triangle_patch[hit.triangle]) && mesh.closed(hit.triangle)) return trace;
    trace.end = "cut at tubes.max_bounces";
    if (static_cast<int>(trace.bounces.size()) == options.max_bounces) return trace;
    const TubeBounce bounce = wave.reflect(hit.triangle, ray.origin + hit.distance * ray.direction);
    ray = {bounce.point, bounce.direction_out, bounce.patch};
    trace.bounces.push_back(bounce);
    trace.end = bounce.goes_on ? "nothing reflected" : "absorbed";
    if (!wave.is_lit()) return trace;
  }
}

}  // namespace raytube
