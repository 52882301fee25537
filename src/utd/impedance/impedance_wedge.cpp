#include "utd/impedance/impedance_wedge.h"

#include <algorithm>
#include <cmath>

#include "utd/wedge/cotangent.h"

namespace raytube {

namespace {

// At phi' = 0 and n pi factors of conductors vanish, and so does what they divide: half of the digits are left.
double clamped_source(double n, const FaceIncidence& incidence) {
  return std::clamp(incidence.source_angle, lit_threshold, n * pi - lit_threshold);
}

}  // namespace

// Obliquely met, with k sin(beta') for k, E = Z eta H of the tangential fields becomes Z / sin(beta') for E along the edge and
// Z sin(beta') for H along it, where what couples the two is left out.
// Impedances below 1e-11 make no difference: theta would be further away than psi is for.
FaceAngle face_angle(EdgeField field, Complex impedance, double sin_cone) {
  if (std::abs(impedance) < 1e-11) return {{}, true};
  return {std::asin(field == EdgeField::soft ? sin_cone / impedance : impedance * sin_cone), false};
}

ImpedanceFace::ImpedanceFace(EdgeField field, double n, const MaliuzhinetsFunction& psi, const FaceAngle& face)
    : field_(field), n_(n), sine_(std::sin(face.angle)) {
  if (!face.conductor) pair_.emplace(psi, pi / 2 - face.angle);
}

Complex ImpedanceFace::factor(const MaliuzhinetsPoint& w) const {
  if (pair_) return (*pair_)(w);
  return field_ == EdgeField::soft ? 1.0 : std::cos(w.at / (2 * n_));
}

Complex ImpedanceFace::reflection(Complex sine) const {
  if (conductor()) return field_ == EdgeField::soft ? -1.0 : 1.0;
  return (sine - sine_) / (sine + sine_);
}

WedgePoint wedge_point(double n, const MaliuzhinetsFunction& psi, Complex g) { return {g, psi.point(n * pi + g), psi.point(g)}; }

WedgePoint source_point(double n, const MaliuzhinetsFunction& psi, const FaceIncidence& incidence) {
  return wedge_point(n, psi, -clamped_source(n, incidence));
}

// The other face's factor is even.
WedgeObserver wedge_observer(double n, const MaliuzhinetsFunction& psi, const GrazingRay& ray) {
  WedgeObserver result{ray, wedge_point(n, psi, ray.angle), {-ray.angle, psi.point(n * pi - ray.angle), {}}};
  result.behind.other = result.front.other;
  return result;
}

ImpedanceKernels whole_kernels(const GrazingRay& ray, Complex front, Complex behind, Complex at_edge) {
  const Complex across = 0.5 * (behind - front) / ray.sine;
  return {0.5 * (front + behind), across, -at_edge - ray.cosine * across};
}

ImpedanceWedge::ImpedanceWedge(EdgeField field, double n, const MaliuzhinetsFunction& psi, const ImpedanceFace& own,
                               const ImpedanceFace& other, const FaceIncidence& incidence, Complex at_source)
    : field_(field),
      n_(n),
      psi_(psi),
      own_(own),
      other_(other),
      source_(clamped_source(n, incidence)),
      lit_(incidence.lit),
      at_source_(at_source),
      reflection_(own.reflection(lit_ ? std::sin(source_) : 0.0)) {}

// Five points: h^4/30 of the fifth derivative.
Complex ImpedanceWedge::ratio_slope(Complex g) const {
  constexpr double h = 1e-3;
  return (8.0 * (ratio(g + h) - ratio(g - h)) - (ratio(g + 2 * h) - ratio(g - 2 * h))) / (12 * h);
}

// at (1/n) cot(x/2n) - ratio_p cot(x/2), `at` the ratio, ratio_p that at the pole x = 0, where it is regular: closer than 1e-4
// the quotient of differences is the slope, to 1e-9.
Complex ImpedanceWedge::term(Complex g, Complex at, const Pole& pole, bool taken_off) const {
  const Complex x = g - pole.angle;
  if (!taken_off) return at * wedge_cotangent(n_, x);
  const bool close = std::abs(x) < 1e-4;
  return at * cotangent_difference(n_, x) + (close ? 2.0 * ratio_slope(g - 0.5 * x) : (at - pole.ratio) * cotangent(0.5 * x));
}

// T(g) less poles of physical optics: that of the reflection boundary, -r/2 cot((g - phi')/2), and that of the shadow, -1/2
// cot((g + phi')/2), each as asked.
Complex ImpedanceWedge::fringe(const WedgePoint& point, bool minus, bool plus) const {
  const Complex at = ratio(point);
  return 0.5 * (term(point.g, at, {source_, -reflection_}, minus) - term(point.g, at, {-source_, 1.0}, plus));
}

Complex ImpedanceWedge::odd_fringe(double g, bool minus, bool plus) const {
  return 0.5 * (fringe(wedge_point(n_, psi_, g), minus, plus) - fringe(wedge_point(n_, psi_, -g), plus, minus));
}

// u at the edge over 2: T(g) for imaginary g without end, where psi(z) becomes psi(pi/2) e^{-jz/4n} / sqrt(2).
Complex ImpedanceWedge::value_at_edge() const {
  if (field_ == EdgeField::soft && (own_.conductor() || other_.conductor())) return 0.0;
  return std::sin(source_ / n_) / (2 * n_ * at_source_);
}

// Closer to g = 0 than h the odd part over sin(g) is taken from there, to h^4.
ImpedanceKernels ImpedanceWedge::regular_kernels(const WedgeObserver& observer, bool pole_active) const {
  constexpr double h = 1e-3;
  const bool one = lit_ || pole_active, two = lit_ && !pole_active;
  const Complex front = fringe(observer.front, one, two), behind = fringe(observer.behind, two, one);
  const auto odd = [&](double at) { return odd_fringe(at, one, two) / std::sin(at); };
  const Complex across =
      std::abs(observer.ray.angle) < h ? (odd(2 * h) - 4.0 * odd(h)) / 3.0 : 0.5 * (behind - front) / observer.ray.sine;
  const Complex constant = (lit_ ? 0.5 * (1.0 + reflection_) : 0.0) - value_at_edge();
  return {0.5 * (front + behind), across, constant - observer.ray.cosine * across};
}

SplitImpedanceKernels ImpedanceWedge::kernels(const WedgeObserver& observer, bool pole_active) const {
  SplitImpedanceKernels result{regular_kernels(observer, pole_active), {}};
  if (!pole_active) return result;
  const Complex across = (lit_ ? -0.25 : 0.25) * (1.0 + reflection_) / observer.ray.sine;
  result.pole = {0.25 * (1.0 - reflection_), across, -observer.ray.cosine * across};
  return result;
}

}  // namespace raytube
