#include "utd/impedance/impedance_strip.h"

#include <algorithm>
#include <cmath>

#include "math/gauss.h"

namespace raytube {

namespace {

constexpr Complex j(0.0, 1.0);

// Along the edge's own face, at cos(g/2) = 1, currents are taken this far off.
double apart_from_grazing(double half_cosine) {
  constexpr double on_grazing = 1e-6;
  return std::abs(half_cosine - 1.0) < on_grazing ? 1.0 - on_grazing : half_cosine;
}

// Whether a pole, by its sin(a/2), lies on the far side of the path, so that there is a guided wave beside the integral.
bool is_guided(Complex sine) { return sine.imag() > sine.real(); }

// Only poles of inductive faces come close to the path.
bool is_near_path(const FaceAngle& face) { return !face.conductor && face.angle.imag() > 0.0; }

// 1 - |s - sigma|^2 / (2 sin^2 beta') of the ray that goes on along the strips less cos(g) of the far edge's own, which goes
// back; both are -cos(phi) on the cone of diffraction.
double off_cone(const FaceIncidence& incidence, const dvec3& scattered) {
  return 2.0 * incidence.cos_cone * (glm::dot(scattered, incidence.tangent) - incidence.cos_cone) /
         (incidence.sin_cone * incidence.sin_cone);
}

// What a guided wave counts by its k over that of free space: a much slower one is none of the impedance, which is that at
// grazing.
double guided_share(Complex pole) { return std::clamp((1.3 - std::abs(std::cos(pole))) / 0.1, 0.0, 1.0); }

// The integral of e^{amid + x slope} over x from -1 to 1.
Complex mean_exponential(Complex amid, Complex slope) {
  const Complex square = slope * slope;
  if (std::norm(slope) < 1e-4) return std::exp(amid) * (1.0 + square / 6.0 * (1.0 + square / 20.0));
  return (std::exp(amid + slope) - std::exp(amid - slope)) / (2.0 * slope);
}

}  // namespace

// All exponents are linear along the edge.
std::array<Complex, 2> StripEcho::over(const StripBundle& strips, double wavenumber) const {
  const double middle = (strips.from + strips.to) / 2, half = (strips.to - strips.from) / 2;
  std::array<Complex, 2> sum{};
  for (const Wave& wave : waves_) {
    const Complex amid = wavenumber * (j * strips.end_path.at(middle) + wave.growth * strips.length_at(middle)),
                  slope = wavenumber * half * (j * strips.end_path.growth + wave.growth * strips.growth);
    const Complex integral = 2 * half * mean_exponential(amid, slope);
    for (int p = 0; p < 2; ++p) sum[p] += integral * wave.received[p];
  }
  return sum;
}

/// Materials of one frequency at both edges: the strip's face first.
struct ImpedanceStrip::Ends {
  std::array<ImpedanceFace, 2> from, to;
  FaceAngle leaving, arriving;  // those of the strip's face at either edge
  Complex at_source;
  std::array<Complex, 4> at_observer;  // faces_at in front and behind, of both faces of the far edge
};

// At the end of the path e^{-20} is left of the waves.
ImpedanceStrip::ImpedanceStrip(const StripEdge& from, const StripEdge& to, const LookVectors& look, double electrical_length,
                               int nodes)
    : from_(from),
      to_(to),
      look_(look),
      cones_(from.incidence[0].sin_cone / to.incidence[0].sin_cone),
      source_(source_point(from.wedge.n, from.psi, from.incidence[from.face])),
      off_cone_(off_cone(to.incidence[to.face], look.scattered)),
      end_(std::polar(std::sqrt(0.5 * 20.0 / electrical_length) / from.incidence[0].sin_cone, pi / 4)) {
  for (const int i : {0, 1}) {
    const int face = i == 0 ? to.face : 1 - to.face;
    const double half_cosine = grazing_half_cosine(to.wedge.faces[face], to.incidence[face], look.scattered);
    observers_[i] = wedge_observer(to.wedge.n, to.psi, grazing_ray_at(apart_from_grazing(half_cosine)));
  }
  lay_path(nodes);
}

// Points are dense at 0, where poles are close.
void ImpedanceStrip::lay_path(int nodes) {
  for (const GaussPoint& point : gauss_rule(nodes)) {
    const Complex sine = point.node * point.node * end_, angle = 2.0 * std::asin(sine),
                  weight = 2.0 * point.node * point.weight * end_;
    path_.push_back(passing(angle, angle, arriving(angle), weight / (pi * std::sqrt(1.0 - sine * sine))));
    points_.push_back({sine, weight});
  }
}

Complex ImpedanceStrip::arriving(Complex angle) const { return 2.0 * std::asin(cones_ * std::sin(0.5 * angle)); }

// Along the strip k sin^2(beta') (cos a - 1) is the same at both edges.
ImpedanceStrip::Passing ImpedanceStrip::passing(Complex at, Complex leaving, Complex arriving, Complex weight) const {
  const double n = from_.wedge.n, beyond = to_.wedge.n, sine = from_.incidence[0].sin_cone;
  const Complex source = -source_.g;
  const WedgePoint own = wedge_point(n, from_.psi, pi + leaving), other = wedge_point(n, from_.psi, pi - n * pi - leaving);
  return {weight,
          -j * sine * sine * (std::cos(at) - 1.0),
          {own, other},
          {whole_wave(n, own.g, source), whole_wave(n, other.g, n * pi - source)},
          {whole_wave(beyond, observers_[0].ray.angle, arriving),
           whole_wave(beyond, observers_[1].ray.angle, beyond * pi - arriving)},
          std::sin(arriving / beyond) / (2 * beyond),
          to_.psi.point(beyond * pi - arriving),
          to_.psi.point(arriving),
          std::sin(leaving),
          std::sin(arriving),
          std::cos(arriving)};
}

// P1 of a unit field, both faces.
Complex ImpedanceStrip::sent(const Ends& ends, const Passing& wave) const {
  const auto& [own, other] = ends.from;
  return -0.5 * j / ends.at_source *
         (faces_at(wave.leaving[0], own, other) * wave.sent[0] + faces_at(wave.leaving[1], other, own) * wave.sent[1]);
}

// What is to be taken off whole_kernels, over `unit` there: the far edge ends the arriving wave's physical optics, ((1-r) sin a',
// 1+r, -(1+r) cos a') / 2, which goes on from there along the strips. whole_kernels follow it back along the edge's own ray: off
// the cone an observer could be in step with a guided wave there, as he never is along the strips.
ImpedanceKernels ImpedanceStrip::beyond(const Ends& ends, const Passing& wave) const {
  const Complex reflected = ends.to[0].reflection(wave.arriving_sine), cosine = wave.arriving_cosine,
                back = cosine - observers_[0].ray.cosine, moved = 0.5 * off_cone_ / (back * (back - off_cone_)),
                across = moved * (1.0 + reflected);
  return {moved * (1.0 - reflected) * wave.arriving_sine, across, -cosine * across};
}

// The tangent of the far edge's face that the strip arrives over is opposite to that of the face it left, that of the other face
// is not.
std::array<Complex, 2> ImpedanceStrip::received(const Ends& ends, const Passing& wave) const {
  const Complex at_source = ends.to[0].factor(wave.at_own) * ends.to[1].factor(wave.at_other);
  const ImpedanceKernels moved = beyond(ends, wave);
  std::array<Complex, 2> sum{};
  for (const int i : {0, 1}) {
    const int face = i == 0 ? to_.face : 1 - to_.face;
    const Complex unit = (i == 0 ? -1.0 : 1.0) / at_source, by_ratio = unit * wave.met[i];
    ImpedanceKernels kernels = whole_kernels(observers_[i].ray, ends.at_observer[2 * i] * by_ratio,
                                             ends.at_observer[2 * i + 1] * by_ratio, unit * wave.at_edge);
    if (i == 0) kernels.along -= moved.along, kernels.across -= moved.across, kernels.axial -= moved.axial;
    const std::array<Complex, 2> of_face = radiated_by_hard(kernels, to_.wedge.faces[face], to_.incidence[face], look_);
    for (int p = 0; p < 2; ++p) sum[p] += of_face[p];
  }
  return sum;
}

void ImpedanceStrip::add(const Ends& ends, const Passing& wave, Complex weight, StripEcho& sum) const {
  std::array<Complex, 2> there = received(ends, wave);
  const Complex amplitude = weight * wave.weight * sent(ends, wave);
  for (Complex& each : there) each *= amplitude;
  sum.add({wave.growth, there});
}

// The integral of 2p / (s^2 - p^2) over s = sin(a/2), p the pole, by a path on its far side, which has the guided wave in it as
// far as that counts, less what the rule makes of it.
Complex ImpedanceStrip::rule_error(Complex angle) const {
  const Complex pole = std::sin(0.5 * angle);
  Complex error = std::log((end_ - pole) / (end_ + pole)) - j * pi;
  for (const auto& [sine, weight] : points_) error -= weight * 2.0 * pole / (sine * sine - pole * pole);
  return is_guided(pole) ? error + 2.0 * pi * j * (1.0 - guided_share(angle)) : error;
}

// What the rule misses by a pole is a wave of the pole's own a; below 1e-4 it does not count.
void ImpedanceStrip::add_pole(const Ends& ends, Complex at, Complex leaving, Complex arriving, Complex residue,
                              StripEcho& sum) const {
  const Complex missed = rule_error(at);
  if (std::abs(missed) > 1e-4) add(ends, passing(at, leaving, arriving, residue / (2 * pi)), missed, sum);
}

// Residues: P1(-a) = r(-a) P1(a) at the first edge and P2(a') = r(a') P2(-a') at the far one; of parallel edges both are one.
void ImpedanceStrip::add_poles(const Ends& ends, StripEcho& sum) const {
  const Complex first = ends.leaving.angle, last = ends.arriving.angle, far = 2.0 * std::asin(std::sin(0.5 * last) / cones_);
  const bool one = std::abs(first - last) < 1e-9;
  add_pole(ends, first, -first, arriving(first), (one ? 4.0 : 2.0) * std::tan(first), sum);
  if (one) return;
  add_pole(ends, far, -far, last, 2.0 * std::tan(last) * std::cos(0.5 * last) / (cones_ * std::cos(0.5 * far)), sum);
}

StripEcho ImpedanceStrip::echo(const std::array<SurfaceImpedance, 2>& from, const std::array<SurfaceImpedance, 2>& to) const {
  const auto angle = [&](const StripEdge& edge, const SurfaceImpedance& of) {
    return face_angle(EdgeField::hard, of, edge.incidence[0].sin_cone);
  };
  const auto at = [&](const StripEdge& edge, const SurfaceImpedance& of) {
    return ImpedanceFace(EdgeField::hard, edge.wedge.n, edge.psi, angle(edge, of));
  };
  Ends ends{{at(from_, from[from_.face]), at(from_, from[1 - from_.face])},
            {at(to_, to[to_.face]), at(to_, to[1 - to_.face])},
            angle(from_, from[from_.face]),
            angle(to_, to[to_.face]),
            {},
            {}};
  ends.at_source = faces_at(source_, ends.from[0], ends.from[1]);
  for (const std::size_t i : {0, 1}) {
    ends.at_observer[2 * i] = faces_at(observers_[i].front, ends.to[i], ends.to[1 - i]);
    ends.at_observer[2 * i + 1] = faces_at(observers_[i].behind, ends.to[i], ends.to[1 - i]);
  }
  StripEcho sum;
  for (const Passing& wave : path_) {
    const Complex back = ends.from[0].reflection(-wave.leaving_sine) * ends.to[0].reflection(wave.arriving_sine);
    add(ends, wave, 1.0 + 1.0 / back, sum);
  }
  if (is_near_path(ends.leaving) && is_near_path(ends.arriving)) add_poles(ends, sum);
  return sum;
}

}  // namespace raytube
