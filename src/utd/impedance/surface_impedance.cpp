#include "utd/impedance/surface_impedance.h"

#include <cmath>

namespace raytube {

namespace {

// Z depends on the square of this cosine of incidence: 1e-8 of it, and 1e-12 is lost in 1 + r.
constexpr double grazing = 1e-4;

}  // namespace

SurfaceImpedance surface_impedance(const Material& material, std::size_t frequency, double wavenumber) {
  if (material.kind == MaterialKind::conductor) return {};
  if (material.kind == MaterialKind::absorber) return {1.0, 1.0};
  const double depth = coat_depth(material, frequency), cosine = depth > 0.0 ? grazing : 1.0;
  const SurfaceResponse::Polarised at_face = smooth_response(material, frequency, wavenumber, cosine, false).reflected;
  const Complex moved = std::polar(1.0, 2 * wavenumber * cosine * depth), te = at_face.te * moved, tm = at_face.tm * moved;
  return {(1.0 + te) / (cosine * (1.0 - te)), cosine * (1.0 - tm) / (1.0 + tm), depth};
}

}  // namespace raytube
