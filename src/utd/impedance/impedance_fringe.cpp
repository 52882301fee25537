#include "utd/impedance/impedance_fringe.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

struct Kernels {
  ImpedanceKernels soft, hard;
};

// Electric and magnetic moments as face_moment gives the electric one of a conductor. Those of the soft field are the dual ones
// of the hard: E, eta H, eta J, M become eta H, -E, M, -eta J.
struct Moments {
  FaceMoment electric, magnetic;
};

Moments moments_of(const Kernels& kernels, const FaceIncidence& incidence, double electric, double magnetic) {
  const double sine = incidence.sin_cone, cosine = incidence.cos_cone;
  return {{kernels.hard.across * magnetic / sine,
           (kernels.soft.along * electric + kernels.hard.axial * (cosine * magnetic)) / (sine * sine)},
          {-kernels.soft.across * electric / sine,
           (kernels.hard.along * magnetic - kernels.soft.axial * (cosine * electric)) / (sine * sine)}};
}

Complex along(const dvec3& direction, const FaceMoment& moment, const WedgeFace& face, const FaceIncidence& incidence) {
  return glm::dot(direction, face.into_face) * moment.across + glm::dot(direction, incidence.tangent) * moment.along;
}

// p . (eta J - s x M).
std::array<Complex, 2> received(const Moments& moments, const WedgeFace& face, const FaceIncidence& incidence,
                                const LookVectors& look) {
  std::array<Complex, 2> result;
  for (const int receive : {0, 1}) {
    const dvec3& p = look.receive[receive];
    result[receive] =
        (along(p, moments.electric, face, incidence) - along(glm::cross(p, look.scattered), moments.magnetic, face, incidence)) /
        (2 * pi);
  }
  return result;
}

ScatteringMatrix radiated(const Kernels& kernels, const WedgeFace& face, const FaceIncidence& incidence,
                          const LookVectors& look) {
  ScatteringMatrix result;
  for (const int transmit : {0, 1}) {
    const Moments moments = moments_of(kernels, incidence, glm::dot(look.electric[transmit], incidence.tangent),
                                       glm::dot(look.magnetic[transmit], incidence.tangent));
    const std::array<Complex, 2> both = received(moments, face, incidence, look);
    for (const int receive : {0, 1}) result.at(receive, transmit) = both[receive];
  }
  return result;
}

ImpedanceFace face_of(EdgeField field, double n, const MaliuzhinetsFunction& psi, const SurfaceImpedance& of, double sin_cone) {
  return {field, n, psi, face_angle(field, of, sin_cone)};
}

}  // namespace

ImpedanceEdge::ImpedanceEdge(const Wedge& wedge, const WedgeIncidence& incidence, const MaliuzhinetsFunction& psi,
                             const LookVectors& look)
    : wedge_(wedge), incidence_(incidence), psi_(psi), look_(look), source_(source_point(wedge.n, psi, incidence.faces[0])) {
  for (const int face : {0, 1}) {
    const FaceIncidence& arriving = incidence.faces[face];
    const double half_cosine = grazing_half_cosine(wedge.faces[face], arriving, look.scattered);
    sides_[face] = {wedge_observer(wedge.n, psi, grazing_ray_at(half_cosine)), grazing_pole_angle(arriving, half_cosine)};
  }
}

std::array<SplitImpedanceKernels, 2> ImpedanceEdge::kernels(EdgeField field, const std::array<SurfaceImpedance, 2>& of) const {
  const auto face = [&](int i) { return face_of(field, wedge_.n, psi_, of[i], incidence_.faces[i].sin_cone); };
  const std::array<ImpedanceFace, 2> faces{face(0), face(1)};
  const Complex at_source = faces_at(source_, faces[0], faces[1]);
  const auto side = [&](int i) {
    return ImpedanceWedge(field, wedge_.n, psi_, faces[i], faces[1 - i], incidence_.faces[i], at_source)
        .kernels(sides_[i].observer, sides_[i].pole_active());
  };
  return {side(0), side(1)};
}

ScatteringMatrix ImpedanceEdge::amplitude(const std::array<SurfaceImpedance, 2>& of, double wavenumber, bool& windowed) const {
  const auto soft = kernels(EdgeField::soft, of), hard = kernels(EdgeField::hard, of);
  ScatteringMatrix sum;
  for (const int i : {0, 1}) {
    const WedgeFace& face = wedge_.faces[i];
    sum += radiated({soft[i].regular, hard[i].regular}, face, incidence_.faces[i], look_);
    if (!sides_[i].pole_active()) continue;
    const WindowedPole window = windowed_pole(sides_[i].pole, wavenumber, face.width);
    windowed = windowed || window.touched;
    sum += (radiated({soft[i].pole, hard[i].pole}, face, incidence_.faces[i], look_) *= window.value);
  }
  const double lag = wavenumber * glm::dot(look_.scattered - look_.incident, edge_below(wedge_, of));
  return sum *= incidence_.weight * std::polar(1.0, lag);
}

// Senior & Volakis (1995), chapter 3: what the integral is at no distance; 2/n at a conductor. Over one it is a quotient of zeros
// where the wave grazes.
Complex ImpedanceEdge::hard_at_edge(const std::array<SurfaceImpedance, 2>& of) const {
  constexpr double beside = 1e-6;
  const double n = wedge_.n;
  FaceIncidence met = incidence_.faces[0];
  met.source_angle = std::clamp(met.source_angle, beside, n * pi - beside);
  const auto face = [&](int i) { return face_of(EdgeField::hard, n, psi_, of[i], met.sin_cone); };
  return std::sin(met.source_angle / n) / (n * faces_at(source_point(n, psi_, met), face(0), face(1)));
}

std::array<Complex, 2> radiated_by_hard(const ImpedanceKernels& kernels, const WedgeFace& face, const FaceIncidence& incidence,
                                        const LookVectors& look) {
  return received(moments_of({{}, kernels}, incidence, 0.0, 1.0), face, incidence, look);
}

// Along the sum of the normals and along their difference. Of a half plane the sum is zero, and the plane lies in the middle.
dvec3 edge_below(const Wedge& wedge, const std::array<SurfaceImpedance, 2>& faces) {
  constexpr double sharpest = 0.07;  // the square of the sum at 15 degrees
  const dvec3 sum = wedge.faces[0].normal + wedge.faces[1].normal, difference = wedge.faces[0].normal - wedge.faces[1].normal;
  const double sum2 = glm::dot(sum, sum), difference2 = glm::dot(difference, difference);
  dvec3 below(0.0);
  if (sum2 > sharpest) below -= (faces[0].depth + faces[1].depth) / sum2 * sum;
  if (difference2 > sharpest) below -= (faces[0].depth - faces[1].depth) / difference2 * difference;
  return below;
}

}  // namespace raytube
