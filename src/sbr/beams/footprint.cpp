#include "sbr/beams/footprint.h"

#include <algorithm>
#include <cmath>

#include "scene/material.h"

namespace raytube {

Footprint footprint(const Beam& beam, const Patch& patch, const SphericalBasis& receive) {
  const dvec3& d = beam.direction;
  const bool from_front = glm::dot(patch.normal, d) < 0.0;
  const dvec3 n = from_front ? patch.normal : -patch.normal;
  const double offset = from_front ? patch.offset : -patch.offset;
  const double per_height = 1.0 / glm::dot(d, n);

  Footprint f;
  f.outgoing.anchor = beam.anchor;
  f.outgoing.base = beam.base + d * ((offset - glm::dot(beam.base, n)) * per_height);
  f.outgoing.along_u = beam.along_u - d * (glm::dot(beam.along_u, n) * per_height);
  f.outgoing.along_v = beam.along_v - d * (glm::dot(beam.along_v, n) * per_height);
  f.area = glm::length(glm::cross(f.outgoing.along_u, f.outgoing.along_v));

  // Exponent of the radiation integral, k [(s - d).r - path], on the surface point of (u, v).
  const dvec3 change = receive.radial - d;
  f.phase = glm::dot(change, f.outgoing.base) - beam.path;
  f.phase_u = glm::dot(change, f.outgoing.along_u);
  f.phase_v = glm::dot(change, f.outgoing.along_v);

  const std::array<dvec3, 2> receive_axes{receive.theta_hat, receive.phi_hat};
  for (int q = 0; q < 2; ++q) {
    const dvec3 current = surface_current_pec(d, beam.field[q], n);
    for (int p = 0; p < 2; ++p) f.weight[p][q] = glm::dot(receive_axes[p], current);
    f.outgoing.field[q] = reflected_field_pec(beam.field[q], n);
  }
  f.outgoing.direction = reflected_direction(d, n);
  f.outgoing.u_hat = reflected_direction(beam.u_hat, n);
  f.outgoing.v_hat = reflected_direction(beam.v_hat, n);
  // The reflected phase function equals the incident one on the plane n.r = offset: d'.r + path' = d.r + path there.
  f.outgoing.path = beam.path + 2.0 * glm::dot(d, n) * offset;
  return f;
}

Complex phase_integral(const Footprint& f, double k, const dvec2& center, double width, double height) {
  const double magnitude = f.area * width * height * sinc(0.5 * k * f.phase_u * width) * sinc(0.5 * k * f.phase_v * height);
  const dvec2 offset = center - f.outgoing.anchor;
  return std::polar(1.0, k * (f.phase + f.phase_u * offset.x + f.phase_v * offset.y)) * magnitude;
}

LeavingWaves leaving_waves(const SpectralSurfaces& surfaces, const Beam& beam, bool reflected, const Patch& patch,
                           const SphericalBasis& receive) {
  const bool from_behind = facing(beam, patch) > 0.0;
  const Incidence incidence{beam.direction, from_behind ? -patch.normal : patch.normal, patch.material, from_behind, reflected};
  if (beam.spectrum) return leaving_waves(surfaces, incidence, *beam.spectrum, receive);
  return leaving_waves(surfaces, incidence, plain_spectrum(beam.field, surfaces.wavenumbers.size()), receive);
}

double largest_weight(const Footprint& f, int p, int q) {
  if (!f.outgoing.spectrum) return std::abs(f.weight[p][q]);
  double largest = 0.0;
  for (const SpectralWave& wave : *f.outgoing.spectrum) largest = std::max(largest, std::abs(wave.weight[p][q]));
  return largest;
}

void add_far_field(ScatteringMatrix& sum, const Footprint& f, std::size_t frequency_index, double k, Complex integral) {
  const Complex scaled = Complex(0.0, -k / (4.0 * pi)) * integral;
  if (f.outgoing.spectrum) {
    const auto& weight = (*f.outgoing.spectrum)[frequency_index].weight;
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) sum.at(p, q) += weight[p][q] * scaled;
    return;
  }
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) sum.at(p, q) += f.weight[p][q] * scaled;
}

}  // namespace raytube
