#include "utd/multiple/thin_plate_edge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace raytube {

namespace {

/// F(phi) for one direction, F(phi) F(phi') for the sums of cosines and of phi sin phi.
Complex split_function(double kappa, double cosine, double turn) {
  const double logarithm = 1 - std::numbers::egamma - std::log(kappa);
  return std::polar(std::exp(kappa * pi / 2 * cosine), kappa * (logarithm * cosine + turn));
}

double source_angle(const FaceIncidence& incidence, bool direct) {
  if (direct) return incidence.source_angle;
  return incidence.lit ? 0.0 : 2 * pi;
}

}  // namespace

ThinPlateCorrection::ThinPlateCorrection(const Wedge& wedge, int face, const FaceIncidence& incidence, double half_cosine,
                                         const dvec3& scattered, bool direct)
    : width_(wedge.thickness() * incidence.sin_cone),
      beyond_(std::max(half_cosine, 1.0)),
      half_cosine_(std::clamp(half_cosine, half_cosine_floor, 1.0)) {
  const double source = source_angle(incidence, direct);  // phi' = pi - source
  source_half_sine_ = std::cos(source / 2);
  source_half_cosine_ = std::sin(source / 2);
  source_cosine_ = -std::cos(source);
  source_sine_ = direct ? std::sin(source) : 0.0;
  source_turn_ = (pi - source) * source_sine_;
  // Where cos phi + cos phi' is nearer to 0 it is evaluated at this distance: the change is of the same size.
  constexpr double pole_distance = 1e-6;
  double pole = 2 * half_cosine_ * half_cosine_ - 1 + source_cosine_;
  if (std::abs(pole) < pole_distance) {
    pole = std::copysign(pole_distance, source_cosine_);
    half_cosine_ = std::sqrt((1 + pole - source_cosine_) / 2);
  }
  const double angle = 2 * std::acos(half_cosine_);
  cosine_ = std::cos(angle);
  sine_ = std::sin(angle);
  turn_ = angle * sine_;
  above_ = glm::dot(scattered, wedge.faces[face].normal) / incidence.sin_cone;
  lit_sign_ = direct ? (incidence.lit ? 1.0 : -1.0) : 0.0;
}

// Total field of the thick half plane, less that of the thin one, less the shift of physical optics from the middle of the plate
// to its sides: parts even and odd about the plate. Every pole at cos phi + cos phi' = 0 cancels.
FringeKernels ThinPlateCorrection::untruncated(double wavenumber) const {
  const double kappa = wavenumber * width_ / (2 * pi), here = pi * kappa * sine_, there = pi * kappa * source_sine_;
  const Complex both = split_function(kappa, cosine_ + source_cosine_, turn_ + source_turn_);
  const Complex side = std::polar(1.0, std::abs(there)), shift = std::cos(here) * side - 1.0;
  const Complex even = both * std::sqrt(std::cos(here) * std::cos(there)) - 1.0;
  const Complex odd = both * std::sqrt(sinc(here) * sinc(there)) - sinc(here) * side;
  const double h = half_cosine_, twice = 2 * (cosine_ + source_cosine_), mu = 1 - 2 * h * h * beyond_ * beyond_;
  const Complex soft =
      (-2 * h * source_half_cosine_ * even + std::abs(source_sine_) * shift - Complex(0.0, above_ * there) * odd) / twice;
  const Complex hard = (lit_sign_ * shift - source_half_sine_ / h * even) / twice;
  // Beyond the cone the value on it fades as the kernels of the half plane do.
  const Complex fading = hard / (beyond_ * beyond_ * beyond_);
  return {soft / beyond_, fading, lit_sign_ / 2 * shift + mu * fading};
}

// Far from the edge the hard current is that of the half plane times F(pi) F(phi'), and ends with it. The rest lives near the
// edge.
void ThinPlateCorrection::correct(StripKernels& kernels, const FringeKernels& half_plane, double wavenumber,
                                  double length) const {
  const FringeKernels change = untruncated(wavenumber);
  const double kappa = wavenumber * width_ / (2 * pi), reached = std::isinf(length) ? 1.0 : -std::expm1(-length);
  Complex gain = split_function(kappa, source_cosine_ - 1, source_turn_) * std::sqrt(std::cos(pi * kappa * source_sine_)) - 1.0;
  if (std::isinf(length)) gain = 0.0;
  FringeKernels& current = kernels.current;
  current.soft += reached * change.soft;
  current.hard += reached * (change.hard - gain * half_plane.hard) + gain * current.hard;
  current.axial += reached * (change.axial - gain * half_plane.axial) + gain * current.axial;
  kernels.end *= 1.0 + gain;
  kernels.soft_end *= 1.0 + gain;
}

bool comes_along_plate(const Wedge& wedge, const dvec3& incident) {
  const WedgeFace& side = wedge.faces[0];
  return wedge.thickness() > 0.0 && std::abs(glm::dot(incident, side.normal)) <= lit_threshold &&
         glm::dot(incident, side.into_face) < 0.0;
}

Complex field_at_edge(const Wedge& wedge, const FaceIncidence& arriving, double wavenumber) {
  const double source = arriving.source_angle, kappa = wavenumber * wedge.thickness() * arriving.sin_cone / (2 * pi);
  return split_function(kappa, -std::cos(source), (pi - source) * std::sin(source));
}

// Across the edge face flows the hard current of the edge, H(edge) = H F(phi'), from one side to the other.
ScatteringMatrix edge_face_amplitude(const Wedge& wedge, const WedgeIncidence& incidence, const LookVectors& look,
                                     double wavenumber) {
  const FaceIncidence& arriving = incidence.faces[0];
  const Complex at_edge = field_at_edge(wedge, arriving, wavenumber);
  const dvec3 outward = glm::cross(wedge.thickness_vector, arriving.tangent);  // normal of the edge face, as long as that is wide
  const bool lit = glm::dot(look.incident, outward) < -lit_threshold * glm::length(outward);
  const double optics = lit ? 2 * sinc(wavenumber / 2 * glm::dot(look.scattered - look.incident, wedge.thickness_vector)) : 0.0;
  const Complex factor(0.0, -incidence.weight * wavenumber / (4 * pi));
  ScatteringMatrix result;
  for (int transmit = 0; transmit < 2; ++transmit) {
    const Complex current = -at_edge * glm::dot(look.magnetic[transmit], arriving.tangent);
    const dvec3 optical = optics * glm::cross(outward, look.magnetic[transmit]);
    for (int receive = 0; receive < 2; ++receive)
      result.at(receive, transmit) =
          factor * (glm::dot(look.receive[receive], wedge.thickness_vector) * current - glm::dot(look.receive[receive], optical));
  }
  return result;
}

}  // namespace raytube
