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

// What goes on behind a sheet.
struct PassingWave {
  Beam beam;
  Spectrum spectrum;
  SurfacesMet met;     // of a spherical wave
  double power = 0.0;  // the share of what was launched
};

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
    const Fields whole = unobstructed(point);
    const bool goes_on = scatter_spherical(plane, point, power(whole));
    const AntennaRay leaving = spherical_->wave(beam_, point);
    return {triangle,
            patch,
            point,
            normal,
            leaving.direction,
            leaving.path,
            beam_.met ? field() : unobstructed(point),
            beam_.met ? power(field()) / power(whole) : 1.0,
            goes_on};
  }

  /// Behind the surface that was met last, if the tube goes on there.
  const PassingWave& passing() const { return passing_; }
  void go_on(PassingWave passing) {
    beam_ = passing.beam;
    hold(std::move(passing.spectrum), std::move(passing.met));
  }

  bool is_lit() const { return (!beam_.spectrum && !beam_.met) || amplitude(spectrum_) > least_amplitude; }

 private:
  using Fields = std::array<ComplexVector, 2>;

  // Mean of both waves.
  static double power(const Fields& field) {
    const double v = norm(field[0]), h = norm(field[1]);
    return 0.5 * (v * v + h * h);
  }

  // Of conductors alone, at a point.
  Fields unobstructed(const dvec3& point) const {
    const AntennaRay wave = spherical_->wave(beam_, point);
    return {ComplexVector{wave.field[0]}, {wave.field[1]}};
  }

  // Keeps what the beam refers to.
  void hold(Spectrum spectrum, SurfacesMet met) {
    spectrum_ = std::move(spectrum), met_ = std::move(met);
    if (spherical_)
      beam_.met = &met_;
    else
      beam_.spectrum = &spectrum_;
  }

  // The reflected beam; true if another one goes on behind the plane.
  bool scatter(const Patch& plane) {
    const bool spectral = beam_.spectrum || plane.material != no_index;
    LeavingWaves waves = spectral ? leaving_waves(surfaces_, beam_, false, plane, receive_) : LeavingWaves{};
    passing_ = {beam_, std::move(waves.transmitted), {}};
    passing_.power = passing_.spectrum.empty() ? 0.0 : power(passing_.spectrum.front().field);
    beam_ = footprint(beam_, plane, receive_).outgoing;
    if (spectral) hold(std::move(waves.reflected), {});
    return amplitude(passing_.spectrum) > least_amplitude;
  }

  // The same of a spherical wave at a point, where a conductor would reflect so much.
  bool scatter_spherical(const Patch& plane, const dvec3& point, double whole) {
    const Beam arriving = beam_;
    beam_ = reflected_spherical(arriving, plane);
    if (!arriving.met && plane.material == no_index) return false;
    SurfacesMet met = with_surface(arriving, {plane.normal, plane.material}, false);
    beam_.met = &met;
    AntennaRay ray = spherical_->wave_at_first(beam_, point);
    LeavingWaves waves = leaving_waves(surfaces_, met, ray, receive_);
    passing_ = {arriving, std::move(waves.transmitted), met};
    passing_.met.surfaces.back().goes_on = true;
    passing_.power = passing_.spectrum.empty() ? 0.0 : power(passing_.spectrum.front().field) / whole;
    hold(std::move(waves.reflected), std::move(met));
    return amplitude(passing_.spectrum) > least_amplitude;
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
  PassingWave passing_;
  std::optional<AntennaPair> antennas_;
  std::optional<SphericalLook> spherical_;
};

// One tube by its ways, each traced to its end before the next.
class WaysOfTube {
 public:
  WaysOfTube(const Tracer& tracer, ReplayedWave& wave, int max_bounces, std::size_t most)
      : tracer_(tracer), wave_(wave), max_bounces_(max_bounces), most_(most) {}

  std::vector<TubeTrace> follow(TubeTrace launched, const Ray& ray) {
    ways_.push_back(std::move(launched));
    rays_.push_back(ray);
    follow(0);
    for (std::size_t way = 1; way < ways_.size(); ++way) {
      wave_.go_on(std::move(waves_[way - 1]));
      follow(way);
    }
    return std::move(ways_);
  }

 private:
  void follow(std::size_t way) {
    Ray ray = rays_[way];
    while (true) {
      Hit hit;
      tracer_.closest_hits({&ray, 1}, {&hit, 1});
      if (!hit) return end(way, TubeEnd::left_the_scene, 0.0);
      if (hit.from_inside) return end(way, TubeEnd::lost, hit.distance);
      if (met(way) == max_bounces_) return end(way, TubeEnd::truncated, hit.distance);
      const TubeBounce bounce = wave_.reflect(hit.triangle, ray.origin + hit.distance * ray.direction);
      ways_[way].bounces.push_back(bounce);
      if (bounce.goes_on && ways_.size() < most_) part(way, ray.direction);
      ray = {bounce.point, bounce.direction_out, bounce.patch};
      if (!wave_.is_lit()) return end(way, bounce.goes_on ? TubeEnd::transmitted : TubeEnd::absorbed, 0.0);
    }
  }

  int met(std::size_t way) const { return ways_[way].parting.met + static_cast<int>(ways_[way].bounces.size()); }

  void end(std::size_t way, TubeEnd how, double leg) {
    TubeTrace& trace = ways_[way];
    trace.ended = how;
    trace.end = words_of(how);
    trace.last_leg = leg;
  }

  // Behind the surface that the way has met last.
  void part(std::size_t way, const dvec3& direction) {
    const TubeTrace& from = ways_[way];
    const TubeBounce& sheet = from.bounces.back();
    TubeTrace behind{from.column, from.row, from.center, sheet.point, direction};
    behind.parting = {way, met(way), wave_.passing().spectrum.front().field, wave_.passing().power};
    rays_.push_back({sheet.point, direction, sheet.patch});
    waves_.push_back(wave_.passing());
    ways_.push_back(std::move(behind));
  }

  const Tracer& tracer_;
  ReplayedWave& wave_;
  int max_bounces_;
  std::size_t most_;
  std::vector<TubeTrace> ways_;
  std::vector<Ray> rays_;           // of each way
  std::vector<PassingWave> waves_;  // of each but the first
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

std::vector<TubeTrace> TubeReplay::follow(const dvec2& at, std::size_t most) const {
  const dvec2 low = to_mesh_origin() + dvec2(grid_.u_begin, grid_.v_begin);
  const dvec2 extent{grid_.columns * grid_.du, grid_.rows * grid_.dv}, inside = at - low;
  if (inside.x < 0.0 || inside.y < 0.0 || inside.x > extent.x || inside.y > extent.y) refuse_outside(at, low, low + extent);
  return follow(std::min(static_cast<std::uint32_t>(inside.x / grid_.du), grid_.columns - 1),
                std::min(static_cast<std::uint32_t>(inside.y / grid_.dv), grid_.rows - 1), most);
}

std::vector<TubeTrace> TubeReplay::follow(std::uint32_t column, std::uint32_t row, std::size_t most) const {
  const dvec2 middle{grid_.u_center(column), grid_.v_center(row)};
  ReplayedWave wave(grid_, look_, scene_, {&wavenumber_, 1}, middle);
  const Ray ray = grid_.ray(column, row);
  return WaysOfTube(scene_.tracer, wave, max_bounces_, most)
      .follow({column, row, to_mesh_origin() + middle, ray.origin, ray.direction}, ray);
}

TubeTrace trace_tube(const ReplayScene& scene, const Look& look, double frequency_hz, const TubeOptions& options,
                     const dvec2& at) {
  return TubeReplay(scene, look, frequency_hz, options).follow(at, 1).front();
}

}  // namespace raytube
