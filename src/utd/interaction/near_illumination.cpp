#include "utd/interaction/near_illumination.h"

#include <algorithm>
#include <cmath>

#include "scene/frequency_bands.h"

namespace raytube {

NearIllumination::NearIllumination(const ReceivingFaces& faces, const LookVectors&, std::span<const double> wavenumbers,
                                   const LitEdgePiece& source, int reflections)
    : faces_(faces),
      wavenumbers_(wavenumbers),
      source_(source),
      reflections_(reflections),
      antenna_(*source.edge, source.wave->antennas->transmit.position()),
      integral_(source, antenna_, wavenumbers, faces.materials),
      tracer_(faces.tree) {}

// About the edge's line the antenna is turned into the half plane opposite, from where the rays run straight on.
NearRow NearIllumination::diffracted_rays(double azimuth) const {
  const WedgeFace& face = source_.edge->wedge->faces[0];
  const dvec3& t = source_.edge->tangent;
  const dvec3 across = std::cos(azimuth) * face.into_face + std::sin(azimuth) * face.normal;
  const double way = antenna_.path_to(0.0);
  const dvec3 direction = (antenna_.distance * across - antenna_.along * t) / way;
  return {
      {source_.edge->origin, t, direction, source_.from, source_.to, 1.0 / way}, {}, across, glm::cross(t, across), {}, &terms_};
}

double NearIllumination::margin(double position, double way) const {
  const double k = least_wavenumber(wavenumbers_), inside = 2 * (1 + reflections_) * faces_.tree.mesh().radius;
  const double cosine = way * antenna_.cos_cone(position), sine = antenna_.sin_cone(position);
  return edge_row::followed_length(inside + 2 * edge_row::followed_length(inside, k, cosine, sine), k, cosine, sine);
}

// Calls visit(row) wherever the rays arrive.
template <class Visit>
void NearIllumination::follow(double azimuth, Visit visit) {
  NearRow rays = diffracted_rays(azimuth);
  if (!ends_at_surface(source_, 0, rays.across)) rays.fan.from -= margin(source_.from, -1.0);
  if (!ends_at_surface(source_, 1, rays.across)) rays.fan.to += margin(source_.to, 1.0);
  const Wedge& wedge = *source_.edge->wedge;
  follow(rays, {}, {wedge.faces[0].patch, wedge.faces[1].patch, wedge.border_patch}, reflections_, visit);
}

template <class Visit>
void NearIllumination::follow(const NearRow& rays, const std::vector<MetFace>& mirrors, const IgnoredPatches& ignored,
                              int reflections, Visit visit) {
  std::vector<FanHit>& hits = hits_[reflections];
  tracer_.trace(rays.fan, ignored, hits);
  for (const FanHit& hit : hits) {
    const std::uint32_t patch = faces_.tree.faces()[hit.face].patch;
    if (!faces_.large[patch]) continue;
    if (reflections == reflections_ && !faces_.first_met.empty() && !std::ranges::binary_search(faces_.first_met, patch))
      continue;
    const Patch& plane = faces_.tree.mesh().patches[patch];
    NearRow row = rays;
    row.hit = hit;
    row.normal = facing_of(rays.fan, plane) > 0.0 ? -plane.normal : plane.normal;
    std::vector<MetFace> met = mirrors;
    if (faces_.materials.any()) met.emplace_back(plane);
    if (std::ranges::any_of(met, [](const MetFace& face) { return face.material != no_index; })) row.faces = met;
    visit(row);
    if (reflections == 0) continue;
    row.fan = reflected_image(rays.fan, hit, plane.normal, plane.offset);
    row.across = glm::reflect(rays.across, plane.normal);
    row.turning = glm::reflect(rays.turning, plane.normal);
    follow(row, met, {patch, no_index, no_index}, reflections - 1, visit);
  }
}

void NearIllumination::at(double azimuth, std::vector<ScatteringMatrix>& density) {
  density.assign(wavenumbers_.size(), {});
  terms_ = edge_wave_terms(source_.edge->wedge->n, source_.incidence.source_angle, azimuth);
  const std::array<double, 2> corners = corners_of(source_, diffracted_rays(azimuth).across);
  follow(azimuth, [&](const NearRow& row) { integral_.add(row, corners, density); });
}

std::optional<PhaseRange> NearIllumination::survey(double azimuth) {
  std::optional<PhaseRange> range;
  const double k = sampling_wavenumber(wavenumbers_);
  follow(azimuth, [&](const NearRow& row) {
    for (const double end : {row.hit.from, row.hit.to}) {
      const double position = std::clamp(std::clamp(end, source_.from, source_.to), row.hit.from, row.hit.to);
      const double phase = k * integral_.ray(row, position).phase;
      range = range ? PhaseRange{std::min(range->low, phase), std::max(range->high, phase)} : PhaseRange{phase, phase};
    }
  });
  return range;
}

}  // namespace raytube
