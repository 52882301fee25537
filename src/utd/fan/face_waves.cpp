#include "utd/fan/face_waves.h"

#include <algorithm>
#include <cmath>

#include "core/reversed.h"
#include "utd/wedge/rounding_guard.h"

namespace raytube {

namespace {

// A wave at a face. Beside its edge a diffracted wave has a part of H along the ray as well (its slopes): that is reflected as H
// across the plane of incidence is, which is exact on conductors.
struct WaveOnFace {
  dvec3 normal, direction;  // the normal against the wave
  Complex along;            // eta H along the ray
  SurfaceResponse response;
  SurfaceWaves waves;

  WaveOnFace(const FaceMaterials& materials, const MetFace& face, const dvec3& d, const ComplexVector& magnetic,
             std::size_t index, double wavenumber)
      : normal(glm::dot(face.normal, d) > 0.0 ? -face.normal : face.normal), direction(d), along(dot(magnetic, d)) {
    const double cosine = std::max(-glm::dot(normal, d), rounding_guard);
    response = materials.response(face.material, index, wavenumber, cosine, glm::dot(face.normal, d) > 0.0);
    waves = waves_at_surface(d, normal, cross(-d, magnetic), response);
  }
};

}  // namespace

SurfaceResponse FaceMaterials::response(std::uint32_t material, std::size_t index, double wavenumber, double cosine,
                                        bool from_behind) const {
  if (material == no_index) return perfect_conductor;
  return raytube::response(materials[material], frequencies[index], wavenumber, cosine, from_behind);
}

ComplexVector reflected_magnetic(const FaceMaterials& materials, const MetFace& face, const dvec3& direction,
                                 const ComplexVector& magnetic, std::size_t index, double wavenumber) {
  const WaveOnFace at(materials, face, direction, magnetic, index, wavenumber);
  const dvec3 leaving = reflected_direction(direction, at.normal);
  return cross(leaving, at.waves.reflected) + (-at.response.reflected.te * at.along) * leaving;
}

std::array<Complex, 2> received_currents(const FaceMaterials& materials, const MetFace& face, const dvec3& direction,
                                         const ComplexVector& magnetic, const FaceReceiver& receiver, std::size_t index,
                                         double wavenumber) {
  const WaveOnFace at(materials, face, direction, magnetic, index, wavenumber);
  const ComplexVector electric =
      at.waves.electric_current + ((1.0 - at.response.reflected.te) * at.along) * glm::cross(at.normal, direction);
  const auto received = [&](const dvec3& p) {
    return dot(electric, p) + dot(at.waves.magnetic_current, glm::cross(receiver.direction, p));
  };
  return {received(receiver.field[0]), received(receiver.field[1])};
}

ChannelWeights weights_after(const FaceMaterials& materials, std::span<const MetFace> faces, const dvec3& direction,
                             const std::array<dvec3, 2>& electric, std::size_t index, double wavenumber) {
  dvec3 d = direction;
  std::array<dvec3, 2> first = electric;
  for (const MetFace& face : reversed(faces)) {
    d = reflected_direction(d, face.normal);
    for (dvec3& field : first) field = reflected_field_pec(field, face.normal);
  }
  std::array<ComplexVector, 2> fields{ComplexVector{first[0]}, ComplexVector{first[1]}};
  for (const MetFace& face : faces) {
    for (ComplexVector& field : fields)
      field = WaveOnFace(materials, face, d, cross(d, field), index, wavenumber).waves.reflected;
    d = reflected_direction(d, face.normal);
  }
  ChannelWeights weights;
  for (std::size_t own = 0; own < 2; ++own)
    for (std::size_t q = 0; q < 2; ++q) weights[own][q] = dot(fields[q], electric[own]) / glm::dot(electric[own], electric[own]);
  return weights;
}

}  // namespace raytube
