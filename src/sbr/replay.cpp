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

[[noreturn]] void refuse_outside(const dvec2& at, const dvec2& low, const dvec2& high) {
  throw InputError(
      fmt::format("trace: --u {} --v {} lies outside the launch rectangle; use u in {:.6g}..{:.6g} m and v in {:.6g}..{:.6g} m",
                  at.x, at.y, low.x, high.x, low.y, high.y));
}

std::string words_of(TubeEnd end) {
  switch (end) {
    case TubeEnd::left_the_scene:
      return "left the scene";
    case TubeEnd::truncated:
      return "cut at tubes.max_bounces";
    case TubeEnd::lost:
      return "lost: met a closed body from inside";
    case TubeEnd::absorbed:
      return "absorbed";
    case TubeEnd::transmitted:
      return "nothing reflected";
  }
  return {};
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
    spherical_.emplace(*antennas_, beam_, surfaces_, 1.0);
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
      return {triangle, patch, point, normal, beam_.direction, path, field(), power(field()), goes_on};
    }
    const bool goes_on = scatter_spherical(plane, point);
    const AntennaRay leaving = spherical_->wave(beam_, point);
    const Fields whole{ComplexVector{leaving.field[0]}, {leaving.field[1]}}, left = beam_.met ? field() : whole;
    return {triangle, patch, point, normal, leaving.direction, leaving.path, left, beam_.met ? power(left) / power(whole) : 1.0,
            goes_on};
  }

  bool is_lit() const { return (!beam_.spectrum && !beam_.met) || amplitude(spectrum_) > least_amplitude; }

 private:
  using Fields = std::array<ComplexVector, 2>;

  // Mean of both waves.
  static double power(const Fields& field) {
    const double v = norm(field[0]), h = norm(field[1]);
    return 0.5 * (v * v + h * h);
  }

  // The same of a spherical wave at a point.
  bool scatter_spherical(const Patch& plane, const dvec3& point) {
    const Beam arriving = beam_;
    beam_ = reflected_spherical(arriving, plane);
    if (!arriving.met && plane.material == no_index) return false;
    met_ = with_surface(arriving, {plane.normal, plane.material}, false);
    beam_.met = &met_;
    AntennaRay ray = spherical_->wave_at_first(beam_, point);
    LeavingWaves waves = leaving_waves(surfaces_, met_, ray, receive_);
    spectrum_ = std::move(waves.reflected);
    return amplitude(waves.transmitted) > least_amplitude;
  }

  // The reflected beam; true if another one goes on behind the plane.
  bool scatter(const Patch& plane) {
    const bool spectral = beam_.spectrum || plane.material != no_index;
    LeavingWaves waves = spectral ? leaving_waves(surfaces_, beam_, false, plane, receive_) : LeavingWaves{};
    beam_ = footprint(beam_, plane, receive_).outgoing;
    spectrum_ = std::move(waves.reflected);
    if (spectral) beam_.spectrum = &spectrum_;
    return amplitude(waves.transmitted) > least_amplitude;
  }

  Fields field() const {
    if (beam_.spectrum || beam_.met) return spectrum_.front().field;
    return {ComplexVector{beam_.field[0]}, {beam_.field[1]}};
  }

  const TriangleMesh& mesh_;
  SpectralSurfaces surfaces_;
  SphericalBasis receive_;
  double to_origin_;
  Beam beam_;
  Spectrum spectrum_;  // the beam's
  SurfacesMet met_;    // the beam's
  std::optional<AntennaPair> antennas_;
  std::optional<SphericalLook> spherical_;
};

}  // namespace

TubeReplay::TubeReplay(const ReplayScene& scene, const Look& look, double frequency_hz, const TubeOptions& options)
    : scene_(scene), look_(look), wavenumber_(wavenumber(frequency_hz)), max_bounces_(options.max_bounces) {
  grid_ = grid_of_look(scene.tracer.mesh(), look, wavelength(frequency_hz), first_density(options), options.up);
  if (grid_.cells() == 0) throw InputError("trace: the target has no projected area in this look; choose another --look");
}

dvec2 TubeReplay::to_mesh_origin() const {
  return -launch_coordinates(incident_beam(grid_, {}, dvec2(0.0)), -scene_.tracer.mesh().center);
}

TubeTrace TubeReplay::follow(const dvec2& at) const {
  const dvec2 low = to_mesh_origin() + dvec2(grid_.u_begin, grid_.v_begin);
  const dvec2 extent{grid_.columns * grid_.du, grid_.rows * grid_.dv}, inside = at - low;
  if (inside.x < 0.0 || inside.y < 0.0 || inside.x > extent.x || inside.y > extent.y) refuse_outside(at, low, low + extent);
  return follow(std::min(static_cast<std::uint32_t>(inside.x / grid_.du), grid_.columns - 1),
                std::min(static_cast<std::uint32_t>(inside.y / grid_.dv), grid_.rows - 1));
}

TubeTrace TubeReplay::follow(std::uint32_t column, std::uint32_t row) const {
  const dvec2 middle{grid_.u_center(column), grid_.v_center(row)};
  ReplayedWave wave(grid_, look_, scene_, {&wavenumber_, 1}, middle);
  Ray ray = grid_.ray(column, row);
  TubeTrace trace{column, row, to_mesh_origin() + middle, ray.origin, ray.direction};
  const auto ends = [&trace](TubeEnd how, double leg) {
    trace.ended = how;
    trace.end = words_of(how);
    trace.last_leg = leg;
    return trace;
  };
  while (true) {
    Hit hit;
    scene_.tracer.closest_hits({&ray, 1}, {&hit, 1});
    if (!hit) return ends(TubeEnd::left_the_scene, 0.0);
    const TriangleMesh& mesh = scene_.tracer.mesh();
    if (wave.from_behind(mesh.triangle_patch[hit.triangle]) && mesh.closed(hit.triangle))
      return ends(TubeEnd::lost, hit.distance);
    if (static_cast<int>(trace.bounces.size()) == max_bounces_) return ends(TubeEnd::truncated, hit.distance);
    const TubeBounce bounce = wave.reflect(hit.triangle, ray.origin + hit.distance * ray.direction);
    ray = {bounce.point, bounce.direction_out, bounce.patch};
    trace.bounces.push_back(bounce);
    if (!wave.is_lit()) return ends(bounce.goes_on ? TubeEnd::transmitted : TubeEnd::absorbed, 0.0);
  }
}

TubeTrace trace_tube(const ReplayScene& scene, const Look& look, double frequency_hz, const TubeOptions& options,
                     const dvec2& at) {
  return TubeReplay(scene, look, frequency_hz, options).follow(at);
}

}  // namespace raytube
