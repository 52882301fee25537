#include "utd/interaction/near_row.h"

#include <algorithm>
#include <cmath>

#include "core/reversed.h"
#include "math/erfc_ray.h"
#include "math/filon.h"
#include "scene/frequency_bands.h"
#include "utd/wedge/detour.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

// The phase within a rule is off a linear one by less than this [rad].
constexpr double most_bend = 1.0;
// Stretches of rays are halved so many times at most: they are 6e-8 of a row then.
constexpr int most_halvings = 24;

// Directions of eta H of a soft and of a hard wave, and of what their slopes add.
std::array<dvec3, 4> magnetic_directions(const NearRay& ray, const dvec3& across, const dvec3& turning, const dvec3& step) {
  return {-turning, ray.sin_cone * step - ray.cos_cone * across, across, turning};
}

}  // namespace

AntennaAtEdge::AntennaAtEdge(const EdgeAxis& edge, const dvec3& antenna)
    : distance(glm::length(glm::cross(antenna - edge.origin, edge.tangent))),
      along(glm::dot(antenna - edge.origin, edge.tangent)) {}

/// At the points of a rule; phases / k but for the linear part, `rate` over half the stretch [m].
struct NearRowIntegral::Samples {
  std::array<NearRay, lanes> rays;
  Reals detour;  // [m]
  Reals left;
  double half, side, middle, rate;

  double bend() const {
    double low = left[0], high = left[0];
    for (std::size_t i = 1; i < lanes; ++i) low = std::min(low, left[i]), high = std::max(high, left[i]);
    return high - low;
  }
};

// The way from the antenna, s', is as the spread of the tube of rays has it: (s' + s) / s' wide at s, with the field s' / (s' +
// s) of that at the edge, so that neither stands in the integrand (Kouyoumjian & Pathak 1974: L = s s' / (s + s') sin^2(beta0)).
NearRay NearRowIntegral::ray(const NearRow& row, double position) const {
  const dvec3 at_edge = source_.edge->origin + position * source_.edge->tangent;
  const NearAntennas& antennas = *source_.wave->antennas;
  const AntennaRay in = antennas.transmit.ray_to(at_edge);
  const double before = antenna_.path_to(position), depth = row.hit.length + row.hit.growth * position;
  NearRay ray;
  ray.sin_cone = antenna_.distance / before;
  ray.cos_cone = (position - antenna_.along) / before;
  ray.path = std::max(0.0, depth / (1.0 - row.fan.divergence * depth) * before * row.fan.divergence);
  ray.spread = before / (before + ray.path);
  ray.parameter = ray.path * ray.spread;
  const dvec3 direction = ray.sin_cone * row.across + ray.cos_cone * row.fan.step;
  const AntennaRay out = antennas.receive->ray_to(row.fan.base + position * row.fan.step + ray.path * direction);
  ray.area = ray.sin_cone * ray.sin_cone / std::abs(glm::dot(row.normal, direction));
  ray.phase = -(in.path + ray.path + out.path);
  const dvec3 turning = -glm::cross(source_.edge->tangent, in.direction) / ray.sin_cone, up = glm::cross(in.direction, turning);
  for (int q = 0; q < 2; ++q) ray.arriving[q] = {glm::dot(up, in.field[q]), glm::dot(turning, in.field[q])};
  if (!row.faces.empty()) {
    set_spectral_currents(row, {out.field, -out.direction}, ray);
    return ray;
  }
  const std::array<dvec3, 4> magnetic = magnetic_directions(ray, row.across, row.turning, row.fan.step);
  for (int c = 0; c < 4; ++c)
    for (int p = 0; p < 2; ++p) ray.current[p][c] = 2.0 * glm::dot(out.field[p], glm::cross(row.normal, magnetic[c]));
  return ray;
}

// From the edge itself on, face by face.
void NearRowIntegral::set_spectral_currents(const NearRow& row, const FaceReceiver& receiver, NearRay& ray) const {
  dvec3 across = row.across, turning = row.turning, step = row.fan.step;
  const std::span<const MetFace> mirrors = std::span(row.faces).first(row.faces.size() - 1);
  for (const MetFace& mirror : reversed(mirrors))
    for (dvec3* each : {&across, &turning, &step}) *each = glm::reflect(*each, mirror.normal);
  const std::array<dvec3, 4> magnetic = magnetic_directions(ray, across, turning, step);
  ray.spectral.resize(wavenumbers_.size());
  for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
    for (int c = 0; c < 4; ++c) {
      dvec3 direction = ray.sin_cone * across + ray.cos_cone * step;
      ComplexVector field{magnetic[c]};
      for (const MetFace& mirror : mirrors) {
        field = reflected_magnetic(materials_, mirror, direction, field, f, wavenumbers_[f]);
        direction = glm::reflect(direction, mirror.normal);
      }
      const auto received = received_currents(materials_, row.faces.back(), direction, field, receiver, f, wavenumbers_[f]);
      for (int p = 0; p < 2; ++p) ray.spectral[f][p][c] = received[p];
    }
}

void NearRowIntegral::add(const NearRow& row, const std::array<double, 2>& corners, std::vector<ScatteringMatrix>& density) {
  const double from = std::max(row.hit.from, source_.from), to = std::min(row.hit.to, source_.to);
  if (from < to) add_in_parts(row, {from, to}, 0, {0, wavenumbers_.size()}, density);
  for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
    add_beside(row, corners[0], 1.0, f, density);
    add_beside(row, corners[1], -1.0, f, density);
  }
}

// As EdgeWaveIntegral has it, by the ray at the corner: the detour of rays that spread is no shorter than that of parallel ones.
// Each wavenumber by itself: the stretches go with it.
void NearRowIntegral::add_beside(const NearRow& row, double corner, double inwards, std::size_t index,
                                 std::vector<ScatteringMatrix>& density) {
  if (!std::isfinite(corner)) return;
  const edge_row::EndRay end{corner, antenna_.cos_cone(corner), antenna_.sin_cone(corner),
                             ray(row, std::clamp(corner, row.hit.from, row.hit.to)).path,
                             std::max(ray(row, row.hit.from).path, ray(row, row.hit.to).path)};
  edge_row::visit_beside(end, inwards, row.hit.from, row.hit.to, wavenumbers_[index], [&](const RowStretch& stretch) {
    add_in_parts(row, stretch, 0, {index, index + 1}, density);
  });
}

// Where distances from the edge reach too far for one rule; not inside the stretch if they do not.
double NearRowIntegral::where_to_split(const NearRow& row, const RowStretch& stretch) const {
  const double unit = edge_row::least_distance / sampling_wavenumber(wavenumbers_);
  const double near = std::max(ray(row, stretch.from).path, unit), far = std::max(ray(row, stretch.to).path, unit);
  if (std::max(near / far, far / near) <= edge_row::most_ratio) return stretch.to;
  const double share = (std::sqrt(near * far) - near) / (far - near);
  return stretch.from + share * (stretch.to - stretch.from);
}

void NearRowIntegral::add_in_parts(const NearRow& row, const RowStretch& stretch, int halvings, Indices indices,
                                   std::vector<ScatteringMatrix>& density) {
  const std::span<const double> wavenumbers = wavenumbers_.subspan(indices.first, indices.end - indices.first);
  double split = halvings < most_halvings && stretch.side == 0.0 ? where_to_split(row, stretch) : stretch.to;
  if (!(split > stretch.from && split < stretch.to)) {
    const Samples samples = sampled(row, stretch);
    work_ += work::near_ray_row + work::near_ray_frequency * static_cast<double>(wavenumbers.size());
    if (halvings >= most_halvings || samples.bend() * sampling_wavenumber(wavenumbers) < most_bend) {
      for (std::size_t f = indices.first; f < indices.end; ++f) density[f] += excited(row, samples, f);
      return;
    }
    split = stretch.middle();
  }
  add_in_parts(row, {stretch.from, split, stretch.corner, stretch.side}, halvings + 1, indices, density);
  add_in_parts(row, {split, stretch.to, stretch.corner, stretch.side}, halvings + 1, indices, density);
}

double NearRowIntegral::detour(const NearRay& ray, double position, double corner) const {
  const double step = corner - position, before = excess(antenna_.distance, position - antenna_.along, step);
  if (ray.path == 0.0) return before + std::abs(step);
  return before + excess(ray.path * ray.sin_cone, -ray.path * ray.cos_cone, step);
}

NearRowIntegral::Samples NearRowIntegral::sampled(const NearRow& row, const RowStretch& stretch) const {
  const FilonRule& rule = FilonRule::get();
  Samples samples;
  samples.half = stretch.half();
  samples.side = stretch.side;
  for (std::size_t i = 0; i < lanes; ++i) {
    const double position = stretch.middle() + stretch.half() * rule.at[i];
    samples.rays[i] = ray(row, position);
    samples.detour[i] = stretch.side == 0.0 ? 0.0 : detour(samples.rays[i], position, stretch.corner);
  }
  const double first = samples.rays[0].phase, last = samples.rays[lanes - 1].phase;
  samples.rate = (last - first) / (rule.at[lanes - 1] - rule.at[0]);
  samples.middle = (first + last) / 2;
  for (std::size_t i = 0; i < lanes; ++i) samples.left[i] = samples.rays[i].phase - samples.middle - samples.rate * rule.at[i];
  return samples;
}

// EdgeIllumination::excited, ray by ray; d(root L)/d(rho) is among the slopes.
ScatteringMatrix NearRowIntegral::excited(const NearRow& row, const Samples& samples, std::size_t index) const {
  const double wavenumber = wavenumbers_[index];
  const Complexes rule = FilonRule::get().weights(wavenumber * samples.rate);
  Reals root, detour_root;
  for (std::size_t i = 0; i < lanes; ++i) {
    root[i] = samples.rays[i].sin_cone * std::sqrt(wavenumber * samples.rays[i].parameter);
    detour_root[i] = std::sqrt(wavenumber * samples.detour[i]);
  }
  const auto share = [&](std::size_t lane, double z2) {
    return samples.side == 0.0 ? std::pair(1.0, 1.0) : edge_row::shares_at_end(z2, wavenumber * samples.detour[lane]);
  };
  const auto [incident, reflected] = edge_row::both_waves(*row.terms, root, share);
  const Complexes step = scaled_erfc(detour_root);
  const double weight = source_.weight * source_.edge->wedge->share * samples.half;
  ScatteringMatrix sum;
  for (std::size_t i = 0; i < lanes; ++i) {
    const NearRay& ray = samples.rays[i];
    Complex factor = rule[i] * std::polar(1.0, wavenumber * (samples.middle + samples.left[i]));
    if (samples.side != 0.0) factor *= -samples.side / 2 * std::polar(1.0, -wavenumber * samples.detour[i]) * step[i];
    const auto sums = [&](const edge_row::Waves& waves) {
      const Complex of_slope = factor / ray.sin_cone;
      return WaveSums{factor * ray.path * waves.value[i], of_slope * ray.spread * waves.outwards[i], of_slope * waves.around[i]};
    };
    const WaveIntegrals waves{sums(incident), sums(reflected)};
    const ExcitedRays rays{ray.arriving, weight * ray.area, ray.sin_cone, ray.cos_cone};
    sum += ray.spectral.empty() ? raytube::excited(rays, ray.current, waves, wavenumber)
                                : raytube::excited(rays, ray.spectral[index], waves, wavenumber);
  }
  return sum;
}

}  // namespace raytube
