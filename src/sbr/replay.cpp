#include "sbr/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "sbr/beams/beam_tree.h"
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

using Fields = std::array<ComplexVector, 2>;  // of unit incident V and H

// Mean of both waves.
double power(const Fields& field) {
  const double v = norm(field[0]), h = norm(field[1]);
  return 0.5 * (v * v + h * h);
}

double amplitude(const Fields& field) { return std::max(norm(field[0]), norm(field[1])); }

// One tube by its ways, each traced to its end before the next. Its waves are those of a tree of beams.
class WaysOfTube {
 public:
  WaysOfTube(const ReplayScene& scene, const LaunchGrid& grid, const Look& look, std::span<const double> wavenumber,
             const dvec2& at, int max_bounces, std::size_t most)
      : scene_(scene),
        surfaces_{scene.materials, wavenumber},
        receive_(spherical_basis(look.receive)),
        to_origin_(glm::dot(grid.direction, mesh().center)),
        at_(at),
        max_bounces_(max_bounces),
        most_(most),
        beams_(mesh(), surfaces_, receive_, incident_beam(grid, spherical_basis(look.transmit), at)) {
    if (look.far()) return;
    antennas_.emplace(look, scene.radar, mesh().center);
    spherical_.emplace(*antennas_, beams_.beam(BeamTree::root), surfaces_, 1.0);
  }

  std::vector<TubeTrace> follow(TubeTrace launched, const Ray& ray) {
    ways_.push_back(std::move(launched));
    begins_.push_back({ray, BeamTree::root});
    for (std::size_t way = 0; way < ways_.size(); ++way) follow(way);
    return std::move(ways_);
  }

 private:
  struct Begin {
    Ray ray;
    std::uint32_t beam;
  };
  // What leaves a surface at a point; `behind` is empty where nothing goes on.
  struct Leaving {
    dvec3 direction;
    double path;  // [m]
    Fields reflected;
    std::optional<Fields> behind{};
    double unobstructed = 1.0;  // power that the wave would have there if all that it has met were conductors
  };

  const TriangleMesh& mesh() const { return scene_.tracer.mesh(); }

  void follow(std::size_t way) {
    auto [ray, beam] = begins_[way];
    while (true) {
      Hit hit;
      scene_.tracer.closest_hits({&ray, 1}, {&hit, 1});
      if (!hit) return end(way, TubeEnd::left_the_scene, 0.0);
      if (hit.from_inside) return end(way, TubeEnd::lost, hit.distance);
      if (met(way) == max_bounces_) return end(way, TubeEnd::truncated, hit.distance);
      const dvec3 point = ray.origin + hit.distance * ray.direction;
      beam = beams_.child(beam, mesh().triangle_patch[hit.triangle], at_);
      const Leaving leaving = leaving_at(beam, point);
      const Patch& plane = beams_.patch(beam);
      const TubeBounce bounce{hit.triangle,
                              beams_.patch_index(beam),
                              point,
                              beams_.from_behind(beam) ? -plane.normal : plane.normal,
                              leaving.direction,
                              leaving.path,
                              leaving.reflected,
                              power(leaving.reflected) / leaving.unobstructed,
                              leaving.behind.has_value()};
      ways_[way].bounces.push_back(bounce);
      if (bounce.goes_on && ways_.size() < most_) part(way, ray.direction, beams_.through(beam), leaving);
      ray = {bounce.point, bounce.direction_out, bounce.patch};
      if (beams_.beam(beam).spectrum || beams_.beam(beam).met)
        if (amplitude(leaving.reflected) <= least_amplitude)
          return end(way, bounce.goes_on ? TubeEnd::transmitted : TubeEnd::absorbed, 0.0);
    }
  }

  Leaving leaving_at(std::uint32_t node, const dvec3& point) const {
    const Beam& beam = beams_.beam(node);
    const std::uint32_t through = beams_.through(node);
    if (!spherical_) {
      Leaving leaving{beam.direction, beam.path + glm::dot(beam.direction, point) + to_origin_, field_of(beam)};
      if (through != no_index) leaving.behind = field_of(beams_.beam(through));
      return leaving;
    }
    const AntennaRay wave = spherical_->wave(beam, point);
    Leaving leaving{wave.direction, wave.path, {ComplexVector{wave.field[0]}, {wave.field[1]}}};
    leaving.unobstructed = power(leaving.reflected);
    if (!beam.met) return leaving;
    AntennaRay ray = spherical_->wave_at_first(beam, point);
    const LeavingWaves waves = leaving_waves(surfaces_, *beam.met, ray, receive_);
    leaving.reflected = waves.reflected.front().field;
    if (through != no_index && raytube::amplitude(waves.transmitted) > least_amplitude)
      leaving.behind = waves.transmitted.front().field;
    return leaving;
  }

  static Fields field_of(const Beam& beam) {
    return beam.spectrum ? beam.spectrum->front().field : Fields{ComplexVector{beam.field[0]}, {beam.field[1]}};
  }

  int met(std::size_t way) const { return ways_[way].parting.met + static_cast<int>(ways_[way].bounces.size()); }

  void end(std::size_t way, TubeEnd how, double leg) {
    TubeTrace& trace = ways_[way];
    trace.ended = how;
    trace.end = words_of(how);
    trace.last_leg = leg;
  }

  // Behind the surface that the way has met last.
  void part(std::size_t way, const dvec3& direction, std::uint32_t beam, const Leaving& leaving) {
    const TubeTrace& from = ways_[way];
    const TubeBounce& sheet = from.bounces.back();
    TubeTrace behind{from.column, from.row, from.center, sheet.point, direction};
    behind.parting = {way, met(way), *leaving.behind, power(*leaving.behind) / leaving.unobstructed};
    begins_.push_back({{sheet.point, direction, sheet.patch}, beam});
    ways_.push_back(std::move(behind));
  }

  const ReplayScene& scene_;
  SpectralSurfaces surfaces_;
  SphericalBasis receive_;
  double to_origin_;
  dvec2 at_;
  int max_bounces_;
  std::size_t most_;
  BeamTree beams_;
  std::optional<AntennaPair> antennas_;
  std::optional<SphericalLook> spherical_;
  std::vector<TubeTrace> ways_;
  std::vector<Begin> begins_;  // of each way
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
  const Ray ray = grid_.ray(column, row);
  return WaysOfTube(scene_, grid_, look_, {&wavenumber_, 1}, middle, max_bounces_, most)
      .follow({column, row, to_mesh_origin() + middle, ray.origin, ray.direction}, ray);
}

TubeTrace trace_tube(const ReplayScene& scene, const Look& look, double frequency_hz, const TubeOptions& options,
                     const dvec2& at) {
  return TubeReplay(scene, look, frequency_hz, options).follow(at, 1).front();
}

}  // namespace raytube
