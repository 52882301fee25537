#include "utd/impedance/impedance_strip.h"

#include <algorithm>
#include <cmath>

#include "math/gauss.h"

namespace raytube {

namespace {

constexpr Complex j(0.0, 1.0);
constexpr int nodes = 20;
constexpr double path_end = 10.0;     // e^{-10} is left there of the waves
constexpr int circle_points = 4;      // round the guided wave's pole; their error is radius^4
constexpr double circle = 0.02;       // [rad]
constexpr double circle_share = 0.1;  // of the distance to a = 0, beyond which the other pole lies
constexpr double on_grazing = 1e-6;   // of cos(g/2): as close to the edge's own face currents are taken that far off
constexpr double slowest = 1.25;      // k of a guided wave over that of free space
constexpr double both_poles = 2.0;

double apart_from_grazing(double half_cosine) {
  return std::abs(half_cosine - 1.0) < on_grazing ? 1.0 - on_grazing : half_cosine;
}

// Right of the path of steepest descent, Re a = gd(Im a). A much slower wave is none of the impedance, which is that at grazing.
bool passed(Complex pole) { return pole.real() > std::atan(std::sinh(pole.imag())) && std::abs(std::cos(pole)) < slowest; }

// Of e^{amid + x slope} over x from -1 to 1.
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
  Complex at_source;
  std::array<Complex, 4> at_observer;  // faces_at in front and behind, of both faces of the far edge
};

// cos a = 1 - j tau^2 over tau, up to what e^{-k l sin^2(beta') tau^2} leaves.
ImpedanceStrip::ImpedanceStrip(const StripEdge& from, const StripEdge& to, const LookVectors& look, double electrical_length)
    : from_(from),
      to_(to),
      look_(look),
      cones_(from.incidence[0].sin_cone / to.incidence[0].sin_cone),
      source_(source_point(from.wedge.n, from.psi, from.incidence[from.face])) {
  for (const int i : {0, 1}) {
    const int face = i == 0 ? to.face : 1 - to.face;
    const double half_cosine = grazing_half_cosine(to.wedge.faces[face], to.incidence[face], look.scattered);
    observers_[i] = wedge_observer(to.wedge.n, to.psi, grazing_ray_at(apart_from_grazing(half_cosine)));
  }
  const double end = std::sqrt(path_end / electrical_length) / from.incidence[0].sin_cone;
  const Complex turn = std::polar(1.0, pi / 4);
  for (const GaussPoint& point : gauss_rule(nodes)) {
    const Complex sine = turn * ((2 * point.node - 1) * end / std::sqrt(2.0));  // of a/2
    path_.push_back(passing(2.0 * std::asin(sine),
                            turn * (2 * end * point.weight * std::sqrt(2.0) / (2 * pi)) / std::sqrt(1.0 - sine * sine)));
  }
}

// Along the strip k sin^2(beta') (cos a - 1) is the same at both edges.
ImpedanceStrip::Passing ImpedanceStrip::passing(Complex angle, Complex weight) const {
  const double n = from_.wedge.n, beyond = to_.wedge.n, sine = from_.incidence[0].sin_cone;
  const Complex arriving = 2.0 * std::asin(cones_ * std::sin(0.5 * angle)), source = -source_.g;
  const WedgePoint own = wedge_point(n, from_.psi, pi + angle), other = wedge_point(n, from_.psi, pi - n * pi - angle);
  return {weight,
          -j * sine * sine * (std::cos(angle) - 1.0),
          {own, other},
          {whole_wave(n, own.g, source), whole_wave(n, other.g, n * pi - source)},
          {whole_wave(beyond, observers_[0].ray.angle, arriving),
           whole_wave(beyond, observers_[1].ray.angle, beyond * pi - arriving)},
          std::sin(arriving / beyond) / (2 * beyond),
          to_.psi.point(beyond * pi - arriving),
          to_.psi.point(arriving)};
}

// P1 of a unit field, both faces.
Complex ImpedanceStrip::sent(const Ends& ends, const Passing& wave) const {
  const auto& [own, other] = ends.from;
  return -0.5 * j / ends.at_source *
         (faces_at(wave.leaving[0], own, other) * wave.sent[0] + faces_at(wave.leaving[1], other, own) * wave.sent[1]);
}

// The tangent of the far edge's face that the strip arrives over is opposite to that of the face it left, that of the other face
// is not.
std::array<Complex, 2> ImpedanceStrip::received(const Ends& ends, const Passing& wave) const {
  const Complex at_source = ends.to[0].factor(wave.at_own) * ends.to[1].factor(wave.at_other);
  std::array<Complex, 2> sum{};
  for (const int i : {0, 1}) {
    const int face = i == 0 ? to_.face : 1 - to_.face;
    const Complex unit = (i == 0 ? -1.0 : 1.0) / at_source, by_ratio = unit * wave.met[i];
    const ImpedanceKernels kernels = whole_kernels(observers_[i].ray, ends.at_observer[2 * i] * by_ratio,
                                                   ends.at_observer[2 * i + 1] * by_ratio, unit * wave.at_edge);
    const std::array<Complex, 2> of_face = radiated_by_hard(kernels, to_.wedge.faces[face], to_.incidence[face], look_);
    for (int p = 0; p < 2; ++p) sum[p] += of_face[p];
  }
  return sum;
}

void ImpedanceStrip::add(const Ends& ends, const Passing& wave, StripEcho& sum) const {
  std::array<Complex, 2> there = received(ends, wave);
  const Complex amplitude = wave.weight * sent(ends, wave);
  for (Complex& each : there) each *= amplitude;
  sum.add({wave.growth, there});
}

StripEcho ImpedanceStrip::echo(const std::array<SurfaceImpedance, 2>& from, const std::array<SurfaceImpedance, 2>& to) const {
  const auto at = [&](const StripEdge& edge, const std::array<SurfaceImpedance, 2>& of, int face) {
    return ImpedanceFace(EdgeField::hard, edge.wedge.n, edge.psi,
                         face_angle(EdgeField::hard, of[face], edge.incidence[0].sin_cone));
  };
  Ends ends{
      {at(from_, from, from_.face), at(from_, from, 1 - from_.face)}, {at(to_, to, to_.face), at(to_, to, 1 - to_.face)}, {}, {}};
  ends.at_source = faces_at(source_, ends.from[0], ends.from[1]);
  for (const std::size_t i : {0, 1}) {
    ends.at_observer[2 * i] = faces_at(observers_[i].front, ends.to[i], ends.to[1 - i]);
    ends.at_observer[2 * i + 1] = faces_at(observers_[i].behind, ends.to[i], ends.to[1 - i]);
  }
  StripEcho sum;
  for (const Passing& wave : path_) add(ends, wave, sum);
  const FaceAngle face = face_angle(EdgeField::hard, from[from_.face], from_.incidence[0].sin_cone);
  if (face.conductor || !passed(-face.angle)) return sum;
  const double radius = std::min(circle, circle_share * std::abs(face.angle));
  for (int i = 0; i < circle_points; ++i) {
    const Complex off = std::polar(radius, 2 * pi * i / circle_points);
    add(ends, passing(-face.angle + off, both_poles * j * off / static_cast<double>(circle_points)), sum);
  }
  return sum;
}

}  // namespace raytube
