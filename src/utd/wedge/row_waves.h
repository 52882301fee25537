// Waves of an edge at the points of a rule along a row of its rays, and where rules begin and end beside an end of the edge: the
// same for rays of a plane wave and of an antenna at a finite distance. Derived in docs/theory/interaction.md.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "math/erfc_ray.h"
#include "math/lanes.h"
#include "utd/wedge/edge_wave.h"

namespace raytube {

/// A stretch of a row over which waves change little enough for one rule.
struct RowStretch {
  double from, to;      // positions [m]
  double corner = 0.0;  // the end of the edge that it lies beside [m]
  double side = 0.0;    // side of that end: 1 inside, -1 beyond it; 0: the rays by themselves
  double half() const { return (to - from) / 2; }
  double middle() const { return (from + to) / 2; }
};

namespace edge_row {

/// Waves on a face no longer change at electrical distances from the edge below this one.
inline constexpr double least_distance = 0.05;
/// Distances from the edge within one rule have at most this ratio, as waves change with their root.
inline constexpr double most_ratio = 8.0;
/// Waves past an end of the edge are followed up to this root of the electrical detour over it: they have faded below 0.01 there
/// and are let fade to nothing, so that no path ends in a jump.
inline constexpr double most_root_detour = 3.0;

/// How far from an end a wave is followed, for rays up to this long [m]; `cosine` is cos(beta0) towards greater positions, and
/// its negative towards smaller ones. There the way over the end is longer than the ray by d = most_root_detour^2 / k: a
/// quadratic equation.
inline double followed_length(double path, double k, double cosine, double sin_cone) {
  const double d = most_root_detour * most_root_detour / k, square = sin_cone * sin_cone;
  return (d * cosine + std::sqrt(d * d + 2 * d * path * square)) / square;
}

/// The shares of what happens at an end of the edge that are a wave's own and its slopes', by the square z^2 of its argument and
/// the electrical detour.
inline std::pair<double, double> shares_at_end(double z2, double detour) {
  const double both = z2 + detour, own = both > 0.0 ? z2 / both : 1.0;
  const double u = detour / (most_root_detour * most_root_detour), rest = std::max(1.0 - u * u * u * u, 0.0);
  const double faded = rest * rest;
  return {faded * own, faded * own * own};
}

/// The ray at an end of the edge, and the longest of the row.
struct EndRay {
  double position, cos_cone, sin_cone, path, longest;
};

/// Calls visit(RowStretch) beside an end, inside it and beyond; `inwards` is 1 if the edge begins there and -1 if it ends. The
/// wave over the end turns by most_root_detour^2 against the ray's, most of it in the outer half.
template <class Visit>
void visit_beside(const EndRay& end, double inwards, double from, double to, double k, Visit visit) {
  for (const double side : {-1.0, 1.0}) {
    const double way = side * inwards, far = followed_length(end.longest, k, way * end.cos_cone, end.sin_cone);
    const double near = std::min(followed_length(end.path, k, way * end.cos_cone, end.sin_cone), far);
    const std::array<double, 4> parts{0.0, near / 2, near, far};
    for (std::size_t i = 1; i < parts.size(); ++i) {
      const double start = end.position + way * parts[i - 1], stop = end.position + way * parts[i];
      const double low = std::max(from, std::min(start, stop)), high = std::min(to, std::max(start, stop));
      if (low < high) visit(RowStretch{low, high, end.position, side});
    }
  }
}

/// Values of waves, and their slopes as WaveSums has them.
struct Waves {
  Complexes value{}, outwards{}, around{};
};

/// At rays of these sqrt(k L) sin(beta0); share(lane, x^2) has the shares of a wave that count and of its slopes.
/// W' = 2jxW - 2 e^{j pi/4} / sqrt(pi).
template <class Share>
Waves waves_at(std::span<const EdgeWaveTerm> terms, const Reals& root, Share share) {
  const double constant = std::sqrt(2 / pi);
  Waves sum;
  for (const EdgeWaveTerm& term : terms) {
    Reals x;
    for (std::size_t lane = 0; lane < lanes; ++lane) x[lane] = term.rate * root[lane];
    const Complexes w = scaled_erfc(x);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const auto [part, slope_part] = share(lane, x[lane] * x[lane]);
      const double slope_re = -2 * x[lane] * w.im[lane] - constant, slope_im = 2 * x[lane] * w.re[lane] - constant;
      const double strength = part * term.strength, along = slope_part * term.strength * x[lane] / 2;
      const double turn = slope_part * term.strength * term.rate_slope * root[lane];
      const double grow = slope_part * term.strength_slope;
      sum.value.re[lane] += strength * w.re[lane];
      sum.value.im[lane] += strength * w.im[lane];
      sum.outwards.re[lane] += along * slope_re;
      sum.outwards.im[lane] += along * slope_im;
      sum.around.re[lane] += turn * slope_re + grow * w.re[lane];
      sum.around.im[lane] += turn * slope_im + grow * w.im[lane];
    }
  }
  return sum;
}

/// The sums of incident and of reflected waves.
struct BothWaves {
  Waves incident, reflected;
};

template <class Share>
BothWaves both_waves(const EdgeWaveTerms& terms, const Reals& root, Share share) {
  const auto each = static_cast<std::size_t>(terms.each);
  return {waves_at(std::span(terms.incident).first(each), root, share),
          waves_at(std::span(terms.reflected).first(each), root, share)};
}

}  // namespace edge_row

}  // namespace raytube
