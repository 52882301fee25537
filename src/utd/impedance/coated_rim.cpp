#include "utd/impedance/coated_rim.h"

#include <cmath>

#include "utd/multiple/thin_plate_edge.h"

namespace raytube {

namespace {

// Normal of the border face, as long as that is wide.
dvec3 outward_of(const Wedge& wedge) {
  return glm::cross(wedge.thickness_vector, glm::cross(wedge.faces[0].into_face, wedge.faces[0].normal));
}

/// The metal of a coated plate, about the same line.
Wedge metal_of(const Wedge& wedge, double coats) {
  Wedge metal = wedge;
  metal.thickness_vector *= 1.0 - coats / wedge.thickness();
  return metal;
}

}  // namespace

double border_cosine(const Wedge& wedge, const dvec3& incident) { return -glm::dot(incident, glm::normalize(outward_of(wedge))); }

// Where a coat goes round the metal, that ends below it by about as much as its thickness would move its edge outwards: neither
// counts. Metal without thickness has no border face.
ScatteringMatrix CoatedRim::amplitude(const RimFaces& of, double wavenumber) const {
  ScatteringMatrix sum;
  const double coats = of.sides[0].depth + of.sides[1].depth;
  if (wedge_.thickness() > coats) {
    const Wedge metal = metal_of(wedge_, coats);
    sum += border_current(metal, half_plane_.hard_at_edge(of.sides), wavenumber);
    if (!of.border_coated) sum += sides(metal, wavenumber);
    sum *= std::polar(1.0, wavenumber * glm::dot(look_.scattered - look_.incident, edge_below(wedge_, of.sides)));
  }
  return sum += optics_taken_off(of.border, wavenumber);
}

// S of J and M is -jk/4pi p . (eta J - s x M) times the integral of the phase.
ScatteringMatrix CoatedRim::optics_taken_off(const SurfaceResponse& border, double wavenumber) const {
  ScatteringMatrix result;
  if (!(border_cosine(wedge_, look_.incident) > lit_threshold)) return result;
  const dvec3 outward = outward_of(wedge_);
  const double width = glm::length(outward),
               phase = sinc(wavenumber / 2 * glm::dot(look_.scattered - look_.incident, wedge_.thickness_vector));
  const Complex factor(0.0, incidence_.weight * wavenumber / (4 * pi) * width * phase);
  for (const int transmit : {0, 1}) {
    const SurfaceWaves waves = waves_at_surface(look_.incident, outward / width, ComplexVector{look_.electric[transmit]}, border);
    for (const int receive : {0, 1}) {
      const dvec3& p = look_.receive[receive];
      result.at(receive, transmit) =
          factor * (dot(waves.electric_current, p) - dot(waves.magnetic_current, glm::cross(p, look_.scattered)));
    }
  }
  return result;
}

// `field`: H along the edge, of unit H of the wave.
ScatteringMatrix CoatedRim::border_current(const Wedge& metal, Complex field, double wavenumber) const {
  const FaceIncidence& arriving = incidence_.faces[0];
  const Complex factor =
      Complex(0.0, incidence_.weight * wavenumber / (4 * pi)) * field * field_at_edge(metal, arriving, wavenumber);
  ScatteringMatrix result;
  for (const int transmit : {0, 1})
    for (const int receive : {0, 1})
      result.at(receive, transmit) = factor * glm::dot(look_.receive[receive], metal.thickness_vector) *
                                     glm::dot(look_.magnetic[transmit], arriving.tangent);
  return result;
}

ScatteringMatrix CoatedRim::sides(const Wedge& metal, double wavenumber) const {
  ScatteringMatrix sum;
  for (const int side : {0, 1}) {
    const WedgeFace& face = metal.faces[side];
    const FaceIncidence& arriving = incidence_.faces[side];
    const ThinPlateCorrection thin(metal, side, arriving, grazing_half_cosine(face, arriving, look_.scattered), look_.scattered,
                                   true);
    sum += face_amplitude(thin.untruncated(wavenumber), face, arriving, look_);
  }
  return sum *= incidence_.weight;
}

}  // namespace raytube
