#include "utd/impedance/surface_impedance.h"

#include <cmath>

#include "utd/wedge/face_impedance.h"

namespace raytube {

SurfaceImpedance surface_impedance(const Material& material, std::size_t frequency, double wavenumber) {
  if (material.kind == MaterialKind::conductor) return {};
  if (material.kind == MaterialKind::absorber) return {1.0, 1.0};
  const double depth = coat_depth(material, frequency), cosine = depth > 0.0 ? grazing_cosine : 1.0;
  const SurfaceResponse::Polarised at_face = smooth_response(material, frequency, wavenumber, cosine, false).reflected;
  const Complex moved = std::polar(1.0, 2 * wavenumber * cosine * depth);
  const auto [soft, hard] = impedance_of({at_face.te * moved, at_face.tm * moved}, cosine);
  return {soft, hard, depth};
}

}  // namespace raytube
