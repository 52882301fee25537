#include "utd/interaction/edge_illumination.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/frequency_bands.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

// The amplitude of a wave between nodes may be off by this share of it: a hundredth of what the rule of its stretch leaves.
constexpr double amplitude_error = 1e-6;
// The work on a row is to this share that beside the ends of the edge.
constexpr double share_at_ends = 0.5;

}  // namespace

PlaneWave PlaneWave::about(const dvec3& point) const {
  if (!antennas) return *this;
  const AntennaRay ray = antennas->transmit.ray_to(point);
  return {ray.direction, ray.field, ray.path - glm::dot(ray.direction, point), antennas};
}

LookVectors look_of(const PlaneWave& wave, const LookVectors& look) {
  LookVectors result = look;
  result.incident = wave.direction;
  result.electric = wave.electric;
  for (int q = 0; q < 2; ++q) result.magnetic[q] = glm::cross(wave.direction, wave.electric[q]);
  return result;
}

// A surface on which the edge ends goes on with its waves as their mirror. An open fan has one on either side, or none.
bool ends_at_surface(const LitEdgePiece& piece, int end, const dvec3& direction) {
  const EdgeAxis& edge = *piece.edge;
  if (end == 0 ? piece.from > 0.0 : piece.to < edge.length) return false;
  return std::ranges::any_of(edge.abutting_faces[end], [&](int face) {
    return edge.wedge->n != 2.0 || glm::dot(direction, edge.wedge->faces[face].normal) > 0.0;
  });
}

// An end at a surface is the middle of the piece and its mirror image.
std::array<double, 2> corners_of(const LitEdgePiece& piece, const dvec3& direction) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const bool first = !ends_at_surface(piece, 0, direction), last = !ends_at_surface(piece, 1, direction);
  return {first  ? piece.from
          : last ? 2 * piece.from - piece.to
                 : -none,
          last    ? piece.to
          : first ? 2 * piece.to - piece.from
                  : none};
}

EdgeIllumination::EdgeIllumination(const ReceivingFaces& faces, const LookVectors& look, std::span<const double> wavenumbers,
                                   const LitEdgePiece& source, int reflections)
    : tree_(faces.tree),
      large_(faces.large),
      first_met_(faces.first_met),
      look_(look),
      wavenumbers_(wavenumbers),
      source_(source),
      materials_(faces.materials),
      reflections_(reflections),
      tracer_(faces.tree),
      band_(wavenumbers),
      amplitudes_(faces.materials.any()
                      ? nullptr
                      : band_.nodes_of_fresnel(EdgeWaveIntegral::least_turn / least_wavenumber(wavenumbers), amplitude_error)) {
  const PlaneWave& wave = *source.wave;
  const dvec3& d = wave.direction;
  const dvec3 turning = -glm::cross(source.edge->tangent, d) / source.incidence.sin_cone, up = glm::cross(d, turning);
  for (int q = 0; q < 2; ++q) arriving_[q] = {glm::dot(up, wave.electric[q]), glm::dot(turning, wave.electric[q])};
}

// Calls visit(footprint) wherever the rays arrive.
template <class Visit>
void EdgeIllumination::follow(Rays rays, Visit visit) {
  if (!ends_at_surface(source_, 0, rays.fan.direction)) rays.fan.from -= margin(-1.0);
  if (!ends_at_surface(source_, 1, rays.fan.direction)) rays.fan.to += margin(1.0);
  const Wedge& wedge = *source_.edge->wedge;
  follow(rays, {wedge.faces[0].patch, wedge.faces[1].patch, wedge.border_patch}, reflections_, visit);
}

template <class Visit>
void EdgeIllumination::follow(const Rays& rays, const IgnoredPatches& ignored, int reflections, Visit visit) {
  std::vector<FanHit>& hits = hits_[reflections];
  tracer_.trace(rays.fan, ignored, hits);
  for (const FanHit& hit : hits) {
    const std::uint32_t patch = tree_.faces()[hit.face].patch;
    if (!large_[patch]) continue;
    if (reflections == reflections_ && !first_met_.empty() && !std::ranges::binary_search(first_met_, patch)) continue;
    const Patch& plane = tree_.mesh().patches[patch];
    visit(footprint(rays, hit, plane));
    if (reflections == 0) continue;
    follow(reflected_rays(rays, hit, plane), {patch, no_index, no_index}, reflections - 1, visit);
  }
}

void EdgeIllumination::at(double azimuth, std::vector<ScatteringMatrix>& density) {
  density.assign(wavenumbers_.size(), {});
  terms_ = edge_wave_terms(source_.edge->wedge->n, source_.incidence.source_angle, azimuth);
  const Rays rays = diffracted_rays(azimuth);
  const EdgeWaveIntegral waves = this->waves(rays.fan.direction);
  follow(rays, [&](const Footprint& on) { radiate(on, waves, density); });
}

void EdgeIllumination::take_apart(double azimuth, double weight, const PathPlace& place, std::vector<ImageEdge>& pieces) {
  terms_ = edge_wave_terms(source_.edge->wedge->n, source_.incidence.source_angle, azimuth);
  const Rays rays = diffracted_rays(azimuth);
  const EdgeWaveIntegral waves = this->waves(rays.fan.direction);
  follow(rays, [&](const Footprint& on) { take_apart(on, waves, weight, place, pieces); });
}

std::optional<PhaseRange> EdgeIllumination::survey(double azimuth) {
  std::optional<PhaseRange> range;
  const double k = sampling_wavenumber(wavenumbers_);
  follow(diffracted_rays(azimuth), [&](const Footprint& on) {
    for (const double end : {on.row.from, on.row.to}) {
      const double position = std::clamp(std::clamp(end, source_.from, source_.to), on.row.from, on.row.to);
      const double phase = k * (on.row.phase + on.row.phase_rate * position);
      range = range ? PhaseRange{std::min(range->low, phase), std::max(range->high, phase)} : PhaseRange{phase, phase};
    }
  });
  return range;
}

// How far beyond an end of the piece rays are followed [m]. Rays that start beyond the target are longer by as much. `way` is -1
// towards smaller positions.
double EdgeIllumination::margin(double way) const {
  const FaceIncidence& in = source_.incidence;
  const double k = least_wavenumber(wavenumbers_), inside = 2 * (1 + reflections_) * tree_.mesh().radius;
  const double first = edge_row::followed_length(inside, k, way * in.cos_cone, in.sin_cone);
  return edge_row::followed_length(inside + 2 * first, k, way * in.cos_cone, in.sin_cone);
}

EdgeIllumination::Rays EdgeIllumination::diffracted_rays(double azimuth) const {
  const WedgeFace& face = source_.edge->wedge->faces[0];
  const dvec3& t = source_.edge->tangent;
  const dvec3 across = std::cos(azimuth) * face.into_face + std::sin(azimuth) * face.normal;
  const dvec3 direction = glm::normalize(source_.incidence.sin_cone * across + source_.incidence.cos_cone * t);
  const dvec3 turning = glm::cross(t, across), up = glm::cross(direction, turning);
  const std::array<dvec3, wave_components> magnetic{-turning, up, across, turning};
  return {{source_.edge->origin, t, direction, source_.from, source_.to}, 0.0, 0.0, magnetic};
}

EdgeWaveIntegral EdgeIllumination::waves(const dvec3& direction) const {
  return {terms_,     source_.incidence.cos_cone,    source_.incidence.sin_cone, source_.from,
          source_.to, corners_of(source_, direction)};
}

// The tube between neighbouring positions and azimuths is rho sin(beta0) wide, rho the distance from the edge's line; reflections
// by planes leave it so.
EdgeIllumination::Footprint EdgeIllumination::footprint(const Rays& rays, const FanHit& hit, const Patch& plane) const {
  const FaceIncidence& in = source_.incidence;
  const RayFan& fan = rays.fan;
  const double facing = glm::dot(plane.normal, fan.direction);
  const dvec3 base = fan.base + hit.length * fan.direction, step = fan.step + hit.growth * fan.direction;
  const double start = glm::dot(source_.wave->direction, source_.edge->origin) + source_.wave->path;
  RayRow row{hit.from, hit.to, rays.path + hit.length, rays.path_rate + hit.growth};
  row.phase = glm::dot(look_.scattered, base) - start - row.path;
  row.phase_rate = glm::dot(look_.scattered, step) - in.cos_cone - row.path_rate;
  Footprint on{row, base, step, in.sin_cone * in.sin_cone / std::abs(facing), {}};
  const dvec3 normal = facing > 0.0 ? -plane.normal : plane.normal;
  if (!meets_conductors(rays, plane)) {
    on.spectral.resize(wavenumbers_.size());
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
      for (int c = 0; c < wave_components; ++c) {
        const auto received = received_currents(materials_, MetFace(plane), fan.direction, magnetic(rays, f, c),
                                                {look_.receive, look_.scattered}, f, wavenumbers_[f]);
        for (int p = 0; p < 2; ++p) on.spectral[f][p][c] = received[p];
      }
    return on;
  }
  for (int c = 0; c < wave_components; ++c) {
    const dvec3 current = 2.0 * glm::cross(normal, rays.magnetic[c]);
    for (int p = 0; p < 2; ++p) on.current[p][c] = glm::dot(look_.receive[p], current);
  }
  return on;
}

bool EdgeIllumination::meets_conductors(const Rays& rays, const Patch& plane) const {
  return rays.spectral.empty() && plane.material == no_index;
}

ComplexVector EdgeIllumination::magnetic(const Rays& rays, std::size_t index, int component) const {
  return rays.spectral.empty() ? ComplexVector{rays.magnetic[component]} : rays.spectral[index][component];
}

EdgeIllumination::Rays EdgeIllumination::reflected_rays(const Rays& rays, const FanHit& hit, const Patch& plane) const {
  Rays next{reflected(rays.fan, hit, plane.normal), rays.path + hit.length, rays.path_rate + hit.growth, rays.magnetic};
  for (dvec3& field : next.magnetic) field = glm::reflect(field, plane.normal);
  if (meets_conductors(rays, plane)) return next;
  next.spectral.resize(wavenumbers_.size());
  for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
    for (int c = 0; c < wave_components; ++c)
      next.spectral[f][c] =
          reflected_magnetic(materials_, MetFace(plane), rays.fan.direction, magnetic(rays, f, c), f, wavenumbers_[f]);
  return next;
}

ScatteringMatrix EdgeIllumination::excited(const Footprint& on, const WaveIntegrals& sums, std::size_t index,
                                           double wavenumber) const {
  const FaceIncidence& in = source_.incidence;
  const ExcitedRays rays{arriving_, source_.weight * source_.edge->wedge->share * on.area, in.sin_cone, in.cos_cone};
  return on.spectral.empty() ? raytube::excited(rays, on.current, sums, wavenumber)
                             : raytube::excited(rays, on.spectral[index], sums, wavenumber);
}

void EdgeIllumination::radiate(const Footprint& on, const EdgeWaveIntegral& waves, std::vector<ScatteringMatrix>& density) {
  if (amplitudes_) return radiate_band(on, waves, density);
  work_ += work::ray_row * static_cast<double>(wavenumbers_.size());
  for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
    density[f] += excited(on, waves.over(on.row, wavenumbers_[f]), f, wavenumbers_[f]);
}

// What is near an end of a long stretch and what is near the other have paths of their own, and amplitudes that change slowly.
// Beside the ends of the edge rules are coarser and move with k: their errors must be those of direct evaluation.
void EdgeIllumination::radiate_band(const Footprint& on, const EdgeWaveIntegral& waves, std::vector<ScatteringMatrix>& density) {
  const RayRow& row = on.row;
  const double middle = sampling_wavenumber(wavenumbers_);
  const auto add = [&](std::vector<ScatteringMatrix>& at_nodes, double position) {
    add_waves(at_nodes, *amplitudes_, wavenumbers_, row.phase + row.phase_rate * position, density);
    at_nodes.clear();
    work_ += work::known_wave * static_cast<double>(wavenumbers_.size());
  };
  for (const RowStretch& stretch : waves.stretches(row, middle)) {
    const bool apart = middle * std::abs(row.phase_rate) * stretch.half() >= EdgeWaveIntegral::least_turn;
    for (const double k : amplitudes_->at) {
      if (!apart) {
        at_nodes_[0].push_back(excited(on, waves.whole(row, stretch, k), 0, k));
        continue;
      }
      const EdgeWaveIntegral::Ends ends = waves.ends(row, stretch, k);
      at_nodes_[0].push_back(excited(on, ends.from, 0, k));
      at_nodes_[1].push_back(excited(on, ends.to, 0, k));
    }
    add(at_nodes_[0], apart ? stretch.from : stretch.middle());
    if (apart) add(at_nodes_[1], stretch.to);
  }
  for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
    density[f] += excited(on, waves.beside_corners(row, wavenumbers_[f]), f, wavenumbers_[f]);
  work_ +=
      work::ray_row * (static_cast<double>(amplitudes_->at.size()) + share_at_ends * static_cast<double>(wavenumbers_.size()));
}

struct EdgeIllumination::RowPieces {
  const EdgeIllumination& of;
  const Footprint& on;
  const EdgeWaveIntegral& waves;
  double weight, wavenumber;
  const PathPlace& place;
  std::vector<ImageEdge>& pieces;
  ScatteringMatrix sum{};  // the sum of those that were put

  void put(double position, ScatteringMatrix s) {
    const EdgeAxis& edge = *of.source_.edge;
    const dvec3 first = edge.origin + std::clamp(position, of.source_.from, of.source_.to) * edge.tangent;
    const dvec3 at = place.at(first, on.base + position * on.step, on.row.phase + on.row.phase_rate * position);
    sum += s;
    pieces.push_back({at, at, s *= weight});
  }

  // Puts a wave by its amplitudes, which are without their phase.
  void put_wave(double position, const WaveIntegrals& sums) {
    ScatteringMatrix s = of.excited(on, sums, 0, wavenumber);
    put(position, s *= std::polar(1.0, wavenumber * (on.row.phase + on.row.phase_rate * position)));
  }

  // What has the phases of the ends of its stretches, and what is beside corners.
  void put(const RayRow& part) {
    for (const RowStretch& stretch : waves.stretches(part, wavenumber)) {
      if (wavenumber * std::abs(part.phase_rate) * stretch.half() < EdgeWaveIntegral::least_turn) {
        put_wave(stretch.middle(), waves.whole(part, stretch, wavenumber));
        continue;
      }
      const EdgeWaveIntegral::Ends ends = waves.ends(part, stretch, wavenumber);
      put_wave(stretch.from, ends.from);
      put_wave(stretch.to, ends.to);
    }
    put((part.from + part.to) / 2, of.excited(on, waves.beside_corners(part, wavenumber), 0, wavenumber));
  }
};

// A wavelength after the other. What rules leave is at the middle.
void EdgeIllumination::take_apart(const Footprint& on, const EdgeWaveIntegral& waves, double weight, const PathPlace& place,
                                  std::vector<ImageEdge>& pieces) const {
  const double k = wavenumbers_.front();
  RowPieces row{*this, on, waves, weight, k, place, pieces};
  const auto count = static_cast<int>(std::ceil((on.row.to - on.row.from) * k / (2.0 * pi)));
  for (int i = 0; i < count; ++i) {
    RayRow part = on.row;
    part.from = glm::mix(on.row.from, on.row.to, static_cast<double>(i) / count);
    part.to = glm::mix(on.row.from, on.row.to, static_cast<double>(i + 1) / count);
    row.put(part);
  }
  row.put((on.row.from + on.row.to) / 2, excited(on, waves.over(on.row, k), 0, k) - row.sum);
}

}  // namespace raytube
