#include "utd/impedance/impedance_fringe.h"

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
ScatteringMatrix radiated(const Kernels& kernels, const WedgeFace& face, const FaceIncidence& incidence,
                          const LookVectors& look) {
  ScatteringMatrix result;
  for (const int transmit : {0, 1}) {
    const Moments moments = moments_of(kernels, incidence, glm::dot(look.electric[transmit], incidence.tangent),
                                       glm::dot(look.magnetic[transmit], incidence.tangent));
    for (const int receive : {0, 1}) {
      const dvec3& p = look.receive[receive];
      result.at(receive, transmit) = (along(p, moments.electric, face, incidence) -
                                      along(glm::cross(p, look.scattered), moments.magnetic, face, incidence)) /
                                     (2 * pi);
    }
  }
  return result;
}

// One face of a wedge, the other one beside it.
struct Side {
  const WedgeFace& face;
  const FaceIncidence& incidence;
  const SurfaceImpedance &own, &other;
};

SplitImpedanceKernels kernels_of(EdgeField field, const Side& side, double n, const MaliuzhinetsFunction& psi,
                                 const GrazingRay& ray, bool pole_active) {
  const auto impedance = [&](const SurfaceImpedance& of) { return field == EdgeField::soft ? of.soft : of.hard; };
  const auto angle = [&](const SurfaceImpedance& of) { return face_angle(field, impedance(of), side.incidence.sin_cone); };
  return ImpedanceWedge(field, n, psi, angle(side.own), angle(side.other), side.incidence).kernels(ray, pole_active);
}

ScatteringMatrix face_part(const Side& side, double n, const MaliuzhinetsFunction& psi, const LookVectors& look,
                           double wavenumber, bool& windowed) {
  const double half_cosine = grazing_half_cosine(side.face, side.incidence, look.scattered);
  const double y = grazing_pole_angle(side.incidence, half_cosine);
  const bool active = y > -1;
  const GrazingRay ray = grazing_ray_at(half_cosine);
  const SplitImpedanceKernels soft = kernels_of(EdgeField::soft, side, n, psi, ray, active),
                              hard = kernels_of(EdgeField::hard, side, n, psi, ray, active);
  ScatteringMatrix part = radiated({soft.regular, hard.regular}, side.face, side.incidence, look);
  if (!active) return part;
  const WindowedPole window = windowed_pole(y, wavenumber, side.face.width);
  windowed = windowed || window.touched;
  ScatteringMatrix pole = radiated({soft.pole, hard.pole}, side.face, side.incidence, look);
  return part += (pole *= window.value);
}

}  // namespace

ScatteringMatrix impedance_edge_amplitude(const Wedge& wedge, const WedgeIncidence& incidence,
                                          const std::array<SurfaceImpedance, 2>& faces, const LookVectors& look,
                                          double wavenumber, bool& windowed) {
  const MaliuzhinetsFunction psi(wedge.n);
  ScatteringMatrix sum;
  for (const int side : {0, 1})
    sum += face_part({wedge.faces[side], incidence.faces[side], faces[side], faces[1 - side]}, wedge.n, psi, look, wavenumber,
                     windowed);
  const double lag = wavenumber * glm::dot(look.scattered - look.incident, edge_below(wedge, faces));
  return sum *= incidence.weight * std::polar(1.0, lag);
}

// Along the sum of the normals and along their difference. Of a half plane the sum is zero, and the plane lies in the middle.
dvec3 edge_below(const Wedge& wedge, const std::array<SurfaceImpedance, 2>& faces) {
  constexpr double sharpest = 0.07;  // of the sum squared, 15 degrees
  const dvec3 sum = wedge.faces[0].normal + wedge.faces[1].normal, difference = wedge.faces[0].normal - wedge.faces[1].normal;
  const double sum2 = glm::dot(sum, sum), difference2 = glm::dot(difference, difference);
  dvec3 below(0.0);
  if (sum2 > sharpest) below -= (faces[0].depth + faces[1].depth) / sum2 * sum;
  if (difference2 > sharpest) below -= (faces[0].depth - faces[1].depth) / difference2 * difference;
  return below;
}

}  // namespace raytube
