#include "sbr/spectrum.h"

#include <algorithm>
#include <cmath>

namespace raytube {

Spectrum plain_spectrum(const std::array<dvec3, 2>& field, std::size_t frequencies) {
  return Spectrum(frequencies, {{ComplexVector{field[0]}, ComplexVector{field[1]}}});
}

bool is_lit(const Spectrum& spectrum) {
  constexpr double least = 1e-9;
  return std::ranges::any_of(spectrum,
                             [](const SpectralWave& wave) { return norm(wave.field[0]) + norm(wave.field[1]) > least; });
}

SurfaceResponse SpectralSurfaces::response(std::uint32_t material, std::size_t frequency, double cosine, bool from_behind) const {
  if (material == no_index) return perfect_conductor;
  return raytube::response(materials[material], frequency, wavenumbers[frequency], cosine, from_behind);
}

double SpectralSurfaces::incoherent_share(std::uint32_t material, std::size_t frequency, double cosine) const {
  if (material == no_index || materials[material].roughness == 0.0) return 0.0;
  return 1.0 - std::pow(coherent_factor(materials[material], wavenumbers[frequency], cosine), 2);
}

namespace {

double incoherent_sigma(const SpectralSurfaces& surfaces, const Incidence& incidence, std::size_t frequency,
                        const ComplexVector& arriving, const dvec3& towards) {
  const double share = surfaces.incoherent_share(incidence.material, frequency, incidence.cosine());
  if (share == 0.0) return 0.0;
  const SurfaceResponse smooth = smooth_response(surfaces.materials[incidence.material], frequency,
                                                 surfaces.wavenumbers[frequency], incidence.cosine(), incidence.from_behind);
  const double reflected = norm(waves_at_surface(incidence.direction, incidence.normal, arriving, smooth).reflected);
  return 4.0 * share * reflected * reflected * std::max(0.0, glm::dot(towards, incidence.normal));
}

}  // namespace

LeavingWaves leaving_waves(const SpectralSurfaces& surfaces, const Incidence& incidence, const Spectrum& arriving,
                           const SphericalBasis& receive) {
  LeavingWaves waves{Spectrum(arriving.size()), Spectrum(arriving.size())};
  const std::array<dvec3, 2> electric{receive.theta_hat, receive.phi_hat},
      magnetic{glm::cross(receive.theta_hat, receive.radial), glm::cross(receive.phi_hat, receive.radial)};
  for (std::size_t f = 0; f < arriving.size(); ++f) {
    const SurfaceResponse response = surfaces.response(incidence.material, f, incidence.cosine(), incidence.from_behind);
    for (std::size_t q = 0; q < 2; ++q) {
      const SurfaceWaves at = waves_at_surface(incidence.direction, incidence.normal, arriving[f].field[q], response);
      waves.reflected[f].field[q] = at.reflected;
      waves.transmitted[f].field[q] = at.transmitted;
      waves.reflected[f].incoherent[q] = incoherent_sigma(surfaces, incidence, f, arriving[f].field[q], receive.radial);
      for (std::size_t p = 0; p < 2; ++p)  // p . (s x M) = (p x s) . M
        waves.reflected[f].weight[p][q] = dot(at.electric_current, electric[p]) - dot(at.magnetic_current, magnetic[p]);
    }
  }
  return waves;
}

}  // namespace raytube
