#include "sbr/beams/spectrum.h"

#include <algorithm>
#include <cmath>

namespace raytube {

Spectrum plain_spectrum(const std::array<dvec3, 2>& field, std::size_t frequencies) {
  return Spectrum(frequencies, {{ComplexVector{field[0]}, ComplexVector{field[1]}}});
}

double amplitude(const Spectrum& spectrum) {
  double largest = 0.0;
  for (const SpectralWave& wave : spectrum) largest = std::max({largest, norm(wave.field[0]), norm(wave.field[1])});
  return largest;
}

SurfaceResponse SpectralSurfaces::response(std::uint32_t material, std::size_t frequency_index, double cosine,
                                           bool from_behind) const {
  if (material == no_index) return perfect_conductor;
  return raytube::response(materials[material], first_frequency_index + frequency_index, wavenumbers[frequency_index], cosine,
                           from_behind);
}

std::array<double, 2> SpectralSurfaces::strongest(const Patch& patch, const dvec3& direction) const {
  if (!transmits(patch.material)) return {1.0, 0.0};
  const double cosine = glm::dot(direction, patch.normal);
  std::array<double, 2> largest{};
  for (std::size_t f = 0; f < wavenumbers.size(); ++f) {
    const auto [reflected, transmitted] = response(patch.material, f, std::abs(cosine), cosine > 0.0);
    largest[0] = std::max({largest[0], std::abs(reflected.te), std::abs(reflected.tm)});
    largest[1] = std::max({largest[1], std::abs(transmitted.te), std::abs(transmitted.tm)});
  }
  return largest;
}

double SpectralSurfaces::incoherent_share(std::uint32_t material, std::size_t frequency_index, double cosine) const {
  if (material == no_index || materials[material].roughness == 0.0) return 0.0;
  return 1.0 - std::pow(coherent_factor(materials[material], wavenumbers[frequency_index], cosine), 2);
}

namespace {

double incoherent_sigma(const SpectralSurfaces& surfaces, const Incidence& incidence, std::size_t frequency_index,
                        const ComplexVector& arriving, const dvec3& towards) {
  const double share = surfaces.incoherent_share(incidence.material, frequency_index, incidence.cosine());
  if (share == 0.0) return 0.0;
  const SurfaceResponse smooth =
      smooth_response(surfaces.materials[incidence.material], surfaces.first_frequency_index + frequency_index,
                      surfaces.wavenumbers[frequency_index], incidence.cosine(), incidence.from_behind);
  const double reflected = norm(waves_at_surface(incidence.direction, incidence.normal, arriving, smooth).reflected);
  return 4.0 * share * reflected * reflected * std::max(0.0, glm::dot(towards, incidence.normal));
}

// p . (s x M) = (p x s) . M
ChannelWeights weights(const std::array<ComplexVector, 2>& electric, const std::array<ComplexVector, 2>& magnetic,
                       const SphericalBasis& receive) {
  const std::array<dvec3, 2> p_hat{receive.theta_hat, receive.phi_hat};
  ChannelWeights result;
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t q = 0; q < 2; ++q)
      result[p][q] = dot(electric[q], p_hat[p]) - dot(magnetic[q], glm::cross(p_hat[p], receive.radial));
  return result;
}

}  // namespace

ChannelWeights radiated(const dvec3& n, const dvec3& d, const std::array<ComplexVector, 2>& field,
                        const SphericalBasis& receive) {
  return weights({cross(n, cross(d, field[0])), cross(n, cross(d, field[1]))}, {cross(-n, field[0]), cross(-n, field[1])},
                 receive);
}

ChannelWeights through_screen(const SpectralSurfaces& surfaces, const Patch& patch, std::size_t frequency_index,
                              const SphericalBasis& receive) {
  return through_screen(surfaces.materials[patch.material], surfaces.first_frequency_index + frequency_index,
                        surfaces.wavenumbers[frequency_index], patch.normal, receive);
}

ChannelWeights received_through(const ChannelWeights& screen, const ChannelWeights& weights) {
  ChannelWeights result;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) result[p][q] = screen[p][0] * weights[0][q] + screen[p][1] * weights[1][q];
  return result;
}

LeavingWaves leaving_waves(const SpectralSurfaces& surfaces, const Incidence& incidence, const Spectrum& arriving,
                           const SphericalBasis& receive) {
  LeavingWaves waves{Spectrum(arriving.size()), Spectrum(arriving.size())};
  const bool only_reflects = incidence.reflected && surfaces.transmits(incidence.material);
  for (std::size_t f = 0; f < arriving.size(); ++f) {
    const SurfaceResponse response = surfaces.response(incidence.material, f, incidence.cosine(), incidence.from_behind);
    SpectralWave& reflected = waves.reflected[f];
    std::array<ComplexVector, 2> electric, magnetic;
    for (std::size_t q = 0; q < 2; ++q) {
      const SurfaceWaves at = waves_at_surface(incidence.direction, incidence.normal, arriving[f].field[q], response);
      reflected.field[q] = at.reflected;
      reflected.incoherent[q] = incoherent_sigma(surfaces, incidence, f, arriving[f].field[q], receive.radial);
      waves.transmitted[f].field[q] = at.transmitted;
      electric[q] = at.electric_current, magnetic[q] = at.magnetic_current;
    }
    const dvec3 leaving = reflected_direction(incidence.direction, incidence.normal);
    reflected.weight =
        only_reflects ? radiated(incidence.normal, leaving, reflected.field, receive) : weights(electric, magnetic, receive);
  }
  return waves;
}

}  // namespace raytube
