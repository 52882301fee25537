#include "utd/wedge/edge_currents.h"

#include <algorithm>
#include <cmath>

#include "math/special/elementary.h"
#include "utd/wedge/cotangent.h"

namespace raytube {

namespace {

// A- and A+ of one face: G_s = (A- - A+)/2, G_h = (A- + A+)/(2 sin g).
struct Terms {
  Complex minus;
  Complex plus;
};

Terms fringe_terms(double n, const FaceIncidence& incidence, Complex g) {
  const double source = incidence.source_angle;
  if (incidence.lit) return {cotangent_difference(n, g - source), cotangent_difference(n, g + source)};
  return {wedge_cotangent(n, g - source), wedge_cotangent(n, g + source)};
}

// These terms without the pole cot(y/2) of forward grazing: -cot(y/2) in A+ of a lit face, +cot(y/2) in A- of a dark one.
// Both faces leave the same pole out, so that the windowed kernels still match where phi' passes pi.
Terms regular_terms(double n, const FaceIncidence& incidence, Complex g, double y) {
  const double source = incidence.source_angle;
  if (incidence.lit) return {cotangent_difference(n, g - source), wedge_cotangent(n, g + source)};
  return {cotangent_difference(n, y), wedge_cotangent(n, g + source)};
}

Terms pole_terms(const FaceIncidence& incidence) { return incidence.lit ? Terms{0.0, -1.0} : Terms{1.0, 0.0}; }

FringeKernels kernels_of(const Terms& terms, const GrazingRay& ray, double constant) {
  const Complex hard = (terms.minus + terms.plus) / (2.0 * ray.sine);
  return {(terms.minus - terms.plus) / 2.0, hard, constant - ray.cosine * hard};
}

double axial_constant(double n, const FaceIncidence& incidence) { return (incidence.lit ? 1.0 : 0.0) - 1 / n; }

// At g = pi (s along the grazing diffracted ray) G_h grows as 1/sin(g), while the moment turns parallel to s: what radiates
// depends on whence s comes to the ray, and its mean over all sides is zero. That is the value on the ray. Within rounding of it
// (4e-16, more by the shortness of an edge) 1/sin(g) fades with the fourth power, or the rounding would be seen: to below 1e-12
// there, and by less than 1e-8 from 1e-9 on.
double sine_on_grazing_ray(double sine) {
  constexpr double width = 1e-11;
  return sine + width * std::pow(width / std::max(sine, 1e-60), 3);
}

void add_scaled(ScatteringMatrix& sum, double factor, const ScatteringMatrix& term) {
  for (int receive = 0; receive < 2; ++receive)
    for (int transmit = 0; transmit < 2; ++transmit) sum.at(receive, transmit) += factor * term.at(receive, transmit);
}

}  // namespace

LookVectors look_vectors(const Look& look) {
  const SphericalBasis transmit = spherical_basis(look.transmit), receive = spherical_basis(look.receive);
  const dvec3 incident = -transmit.radial;
  return {incident,
          receive.radial,
          {transmit.theta_hat, transmit.phi_hat},
          {glm::cross(incident, transmit.theta_hat), glm::cross(incident, transmit.phi_hat)},
          {receive.theta_hat, receive.phi_hat}};
}

GrazingRay grazing_ray_at(double half_cosine) {
  const double cosine = 2 * half_cosine * half_cosine - 1;
  const double half_sine = std::sqrt(std::abs(1 - half_cosine) * (1 + half_cosine));
  if (half_cosine > 1) return {{0.0, 2 * inverse_cosh(half_cosine)}, {0.0, 2 * half_cosine * half_sine}, cosine};
  const double g = 2 * std::acos(half_cosine);
  // G_h is even in g, and A- + A+ loses its digits as g -> 0: there the limit is taken along imaginary g, where none are lost.
  // The switch at the cube root of rounding leaves 4e-11 at worst.
  if (g < 6e-6) return {{0.0, 1e-8}, {0.0, 1e-8}, 1.0};
  return {g, sine_on_grazing_ray(2 * half_cosine * half_sine), cosine};
}

double grazing_half_cosine(const dvec3& into_face, const FaceIncidence& incidence, const dvec3& scattered) {
  const dvec3 grazing_ray = incidence.sin_cone * into_face + incidence.cos_cone * incidence.tangent;
  return glm::length(scattered - grazing_ray) / (2 * incidence.sin_cone);
}

FringeKernels fringe_kernels(double n, const FaceIncidence& incidence, const GrazingRay& ray) {
  return kernels_of(fringe_terms(n, incidence, ray.angle), ray, axial_constant(n, incidence));
}

// c_n(g) / sin(g) and -tan(g/2n) / (n sin g), also where g is imaginary; cot(g/2) = (1 + cos g) / sin g.
double grazing_hard_kernel(double n, bool own_face, const GrazingRay& ray) {
  const bool is_imaginary = ray.angle.real() == 0.0;
  const double g = is_imaginary ? ray.angle.imag() : ray.angle.real();
  const double sine = is_imaginary ? ray.sine.imag() : ray.sine.real();
  const double tangent = is_imaginary ? std::tanh(g / (2 * n)) : std::tan(g / (2 * n));
  if (!own_face) return -tangent / (n * sine);
  const double sign = is_imaginary ? -1.0 : 1.0;
  if (g < series_below) return g / sine * difference_over_argument(n, sign * g * g);
  return sign * (1 / (n * tangent) - (1 + ray.cosine.real()) / sine) / sine;
}

// From the two small angles themselves, so that none of their digits is lost.
double grazing_pole_angle(const FaceIncidence& incidence, double half_cosine) {
  return -(2 * std::asin(std::min(half_cosine, 1.0)) + std::abs(pi - incidence.source_angle));
}

SplitKernels split_kernels(double n, const FaceIncidence& incidence, double half_cosine) {
  const GrazingRay ray = grazing_ray_at(half_cosine);
  SplitKernels result;
  const double y = grazing_pole_angle(incidence, half_cosine);
  if (y <= -1) {
    result.regular = fringe_kernels(n, incidence, ray);
    return result;
  }
  result.regular = kernels_of(regular_terms(n, incidence, ray.angle, y), ray, axial_constant(n, incidence));
  result.pole = kernels_of(pole_terms(incidence), ray, 0.0);
  result.angle = y;
  result.active = true;
  return result;
}

WindowedPole windowed_pole(double angle, double wavenumber, double face_width) {
  const double y2 = angle * angle;
  const double delta2 = 1 / (2 * wavenumber * face_width);  // delta^2 with delta = sqrt(2/(k l))/2
  const double blur = delta2 * (1 - y2) * (1 - y2);
  if (angle == 0.0) return {0.0, true};
  return {y2 / std::tan(angle / 2) / (y2 + blur), blur > 1e-6 * (y2 + blur)};
}

FaceMoment face_moment(const FringeKernels& kernels, const FaceIncidence& incidence, double electric, double magnetic) {
  const double sine = incidence.sin_cone;
  return {kernels.hard * magnetic / sine,
          (kernels.soft * electric + kernels.axial * (incidence.cos_cone * magnetic)) / (sine * sine)};
}

ScatteringMatrix face_amplitude(const FringeKernels& kernels, const WedgeFace& face, const FaceIncidence& incidence,
                                const LookVectors& look) {
  ScatteringMatrix result;
  for (int transmit = 0; transmit < 2; ++transmit) {
    const FaceMoment moment = face_moment(kernels, incidence, glm::dot(look.electric[transmit], incidence.tangent),
                                          glm::dot(look.magnetic[transmit], incidence.tangent));
    for (int receive = 0; receive < 2; ++receive)
      result.at(receive, transmit) = (glm::dot(look.receive[receive], face.into_face) * moment.across +
                                      glm::dot(look.receive[receive], incidence.tangent) * moment.along) /
                                     (2 * pi);
  }
  return result;
}

// Both sides of a half plane have the same fringe current, what is not geometrical optics being symmetric about its plane
// (Sommerfeld 1896), unless the light runs along it.
EdgeAmplitude edge_amplitude(const Wedge& wedge, const WedgeIncidence& incidence, const LookVectors& look) {
  const int sides = ends_sheet(wedge) && incidence.faces[0].lit != incidence.faces[1].lit ? 1 : 2;
  const double weight = wedge.share * incidence.weight * 2.0 / sides;
  EdgeAmplitude result;
  for (int side = 0; side < sides; ++side) {
    const WedgeFace& face = wedge.faces[side];
    const FaceIncidence& arriving = incidence.faces[side];
    const SplitKernels kernels = split_kernels(wedge.n, arriving, grazing_half_cosine(face, arriving, look.scattered));
    add_scaled(result.regular, weight, face_amplitude(kernels.regular, face, arriving, look));
    if (!kernels.active) continue;
    result.poles[side] = {.amplitude = {}, .angle = kernels.angle, .face_width = face.width, .active = true};
    add_scaled(result.poles[side].amplitude, weight, face_amplitude(kernels.pole, face, arriving, look));
  }
  return result;
}

ScatteringMatrix amplitude_at(const EdgeAmplitude& amplitude, double wavenumber, bool& windowed) {
  ScatteringMatrix result = amplitude.regular;
  for (const EdgeAmplitude::Pole& pole : amplitude.poles) {
    if (!pole.active) continue;
    const WindowedPole window = windowed_pole(pole.angle, wavenumber, pole.face_width);
    add_scaled(result, window.value, pole.amplitude);
    windowed = windowed || window.touched;
  }
  return result;
}

}  // namespace raytube
