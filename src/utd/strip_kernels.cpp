#include "utd/strip_kernels.h"

#include <algorithm>
#include <cmath>

#include "utd/erfc_ray.h"

namespace raytube {

namespace {

// Observer along the strip itself: the kernels have a removable 0/0 there. At this distance the digits lost to it (1e-16/h) and
// the change of the kernels (h) are both small; the moment is then parallel to s and radiates no more than h itself.
constexpr double half_cosine_floor = 2e-5;
// Source in the plane of the face: phi' keeps to its own side of pi by at least the lit threshold.
constexpr double closest_to_plane = lit_threshold;

double total_strength(const auto& terms, int count) {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += terms[i].strength;
  return sum;
}

}  // namespace

// Kouyoumjian and Pathak (1974) with the observer on the face, phi = 0: N is the nearest integer to (phi' +- pi) / (2 pi n).
Strip::Term Strip::term(double n, double source, int sign) {
  const double beta = 2 * pi * n * std::round((sign * pi + source) / (2 * pi * n)) - source;
  const double eps = pi - sign * beta;    // signed angular distance to the boundary
  const double sine = std::sin(eps / 2);  // cos(beta/2), while sin(beta/2) = +-cos(eps/2)
  return {-std::abs(sine) / (2 * n * std::tan(eps / (2 * n))), std::abs(sine),
          sign * std::cos(eps / 2) * std::copysign(0.5, sine)};
}

Strip::Strip(double n, FaceIncidence incidence, double half_cosine) : half_cosine_(std::max(half_cosine, half_cosine_floor)) {
  double& source = incidence.source_angle;
  source = incidence.lit ? std::min(source, pi - closest_to_plane) : std::max(source, pi + closest_to_plane);
  terms_ = {term(n, source, +1), term(n, source, -1)};
  // A wave that grazes this face or the other one: both terms are the same wave, and it has no soft part.
  if (source == 0.0 || source == n * pi) {
    terms_[0] = {terms_[0].strength + terms_[1].strength, terms_[0].distance, 0.0};
    term_count_ = 1;
  }
  if (n != 2.0) add_local_part(n, incidence);
}

// The kernels of an endless strip, exact (Michaeli 1986) minus uniform.
void Strip::add_local_part(double n, const FaceIncidence& incidence) {
  const FringeKernels exact = fringe_kernels(n, incidence, glance_at(half_cosine_));
  const FringeKernels uniform = endless().current;
  const double step = (incidence.lit ? 1.0 : 0.0) - 1 / n + total_strength(terms_, term_count_);
  local_ = {exact.soft - uniform.soft, exact.hard - uniform.hard, step};
}

StripKernels Strip::endless() const {
  Complex soft = local_.soft, hard = local_.hard;
  for (int i = 0; i < term_count_; ++i) {
    const Term& t = terms_[i];
    const double sum = t.distance + half_cosine_;
    hard -= t.strength / (2 * half_cosine_ * sum);
    soft -= 2 * t.strength * t.slope / sum;
  }
  const double mu = 1 - 2 * half_cosine_ * half_cosine_;
  const Complex axial = mu * hard - total_strength(terms_, term_count_) + local_.axial;
  return {{soft, hard, axial}, 0.0, 0.0};
}

StripKernels Strip::at(double length) const {
  if (std::isinf(length)) return endless();
  const double root = std::sqrt(2 * length), h = half_cosine_, x = h * root;
  const Complex here = scaled_erfc(x), decay = std::polar(1.0, -x * x), ratio = erf_over(x, here, decay);
  // Of the local part, which lives within xi < 1 of the edge; all of it, to rounding, on a strip of six wavelengths.
  const double reached = length > 37.0 ? 1.0 : -std::expm1(-length);
  Complex soft = reached * local_.soft, hard = reached * local_.hard, arriving = 0.0;
  for (int i = 0; i < term_count_; ++i) {
    const Term& t = terms_[i];
    const double boundary = t.distance * root;
    const Complex there = scaled_erfc(boundary), difference = decay * divided_difference(boundary, x, there, here);
    const double share = t.strength / (t.distance + h);
    hard -= 0.5 * share * root * (ratio + difference);
    soft += 2 * share * t.slope * (boundary * difference - x * ratio);
    arriving += t.strength * there;
  }
  const double mu = 1 - 2 * h * h;
  const Complex axial = mu * hard + decay * arriving - total_strength(terms_, term_count_) + reached * local_.axial;
  return {{soft, hard, axial}, decay, arriving};
}

}  // namespace raytube
