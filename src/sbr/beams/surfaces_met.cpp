#include "sbr/beams/surfaces_met.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

Incidence incidence_on(const MetSurface& surface, const dvec3& direction, bool reflected) {
  const bool from_behind = glm::dot(direction, surface.normal) > 0.0;
  return {direction, from_behind ? -surface.normal : surface.normal, surface.material, from_behind, reflected};
}

// A receiver's wave as the basis that weights are linear in.
SphericalBasis basis_of(const AntennaRay& received) { return {-received.direction, received.field[0], received.field[1]}; }

// The wave goes on from a surface: its fields and direction.
void meet(const SpectralSurfaces& surfaces, const MetSurface& surface, dvec3& direction, Spectrum& wave) {
  const Incidence at = incidence_on(surface, direction, false);
  for (std::size_t f = 0; f < wave.size(); ++f) {
    const SurfaceResponse response = surfaces.response(at.material, f, at.cosine(), at.from_behind);
    for (ComplexVector& field : wave[f].field) {
      const SurfaceWaves waves = waves_at_surface(direction, at.normal, field, response);
      field = surface.goes_on ? waves.transmitted : waves.reflected;
    }
  }
  if (!surface.goes_on) direction = reflected_direction(direction, surface.normal);
}

ChannelWeights difference(const ChannelWeights& a, const ChannelWeights& b) {
  ChannelWeights result;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) result[p][q] = a[p][q] - b[p][q];
  return result;
}

// The weights before the last of the screens become what it adds to them.
void see_through(const SpectralSurfaces& surfaces, std::span<const MetSurface> screens, const AntennaRay& received,
                 std::vector<ChannelWeights>& weights) {
  const SphericalBasis antenna{-received.direction, glm::normalize(received.field[0]), glm::normalize(received.field[1])};
  for (std::size_t f = 0; f < weights.size(); ++f)
    for (std::size_t i = 0; i < screens.size(); ++i) {
      const ChannelWeights through =
          received_through(through_screen(surfaces, {screens[i].normal, 0.0, screens[i].material}, f, antenna), weights[f]);
      weights[f] = i + 1 < screens.size() ? through : difference(through, weights[f]);
    }
}

}  // namespace

SurfacesMet with_surface(const Beam& beam, const MetSurface& surface, bool reflected) {
  SurfacesMet met = beam.met ? *beam.met : SurfacesMet{beam, {}};
  met.surfaces.push_back(surface);
  met.reflected = reflected;
  return met;
}

LeavingWaves leaving_waves(const SpectralSurfaces& surfaces, const SurfacesMet& met, AntennaRay& ray,
                           const SphericalBasis& receive) {
  Spectrum wave = plain_spectrum(ray.field, surfaces.wavenumbers.size());
  for (std::size_t i = 0; i + 1 < met.surfaces.size(); ++i) meet(surfaces, met.surfaces[i], ray.direction, wave);
  return leaving_waves(surfaces, incidence_on(met.surfaces.back(), ray.direction, met.reflected), wave, receive);
}

ReceivedCurrents received_currents(const SpectralSurfaces& surfaces, const SurfacesMet& met, AntennaRay& ray,
                                   const AntennaRay& received) {
  const SphericalBasis receive = basis_of(received);
  const LeavingWaves waves = leaving_waves(surfaces, met, ray, receive);
  const Incidence last = incidence_on(met.surfaces.back(), ray.direction, met.reflected);
  ReceivedCurrents at;
  const bool returns_alone = !met.screens.empty() && !met.reflected;  // shadows are not seen through screens
  for (const SpectralWave& wave : waves.reflected)
    at.weight.push_back(returns_alone
                            ? radiated(last.normal, reflected_direction(last.direction, last.normal), wave.field, receive)
                            : wave.weight);
  if (!met.screens.empty()) {
    see_through(surfaces, met.screens, received, at.weight);
  } else if (surfaces.any_rough()) {
    const double received_power = glm::dot(received.field[0], received.field[0]);
    for (const SpectralWave& wave : waves.reflected)
      at.incoherent.push_back(
          {last.cosine() * received_power * wave.incoherent[0], last.cosine() * received_power * wave.incoherent[1]});
  }
  return at;
}

std::array<double, 2> strongest(const SpectralSurfaces& surfaces, const Beam& beam, const Patch& plane, double radius) {
  constexpr double grazing = 1e-9;
  if (plane.material == no_index) return {1.0, 0.0};
  std::array<double, 2> largest{};
  for (const dvec2& at : {dvec2(0.0), dvec2(radius, 0.0), dvec2(-radius, 0.0), dvec2(0.0, radius), dvec2(0.0, -radius)}) {
    const dvec3 ray = glm::normalize(beam.direction + beam.curvature * (at.x * beam.u_hat + at.y * beam.v_hat));
    const double cosine = glm::dot(ray, plane.normal);
    for (std::size_t f = 0; f < surfaces.wavenumbers.size(); ++f) {
      const auto [reflected, transmitted] =
          surfaces.response(plane.material, f, std::max(std::abs(cosine), grazing), cosine > 0.0);
      largest[0] = std::max({largest[0], std::abs(reflected.te), std::abs(reflected.tm)});
      largest[1] = std::max({largest[1], std::abs(transmitted.te), std::abs(transmitted.tm)});
    }
  }
  return largest;
}

}  // namespace raytube
