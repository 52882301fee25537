// Kernels of single strips, and scattering by a flat strip of two parallel edges built from them: the edge pass in two
// dimensions.
#pragma once

#include <cmath>
#include <limits>
#include <span>

#include "utd/multiple/strip_kernels.h"

namespace raytube::testing {

inline FaceIncidence incidence_at(double source_angle) { return {dvec3(0, 0, 1), 0.0, 1.0, source_angle, source_angle < pi}; }

inline double half_cosine_of(double mu) { return std::sqrt((1 - mu) / 2); }

inline StripKernels kernels_at(const Strip& strip, double length) {
  KernelBatch batch;
  strip.at(std::span(&length, 1), batch);
  return batch[0];
}

/// Of the current between two lengths.
inline StripKernels piece_of(const Strip& strip, double begin, double end) {
  KernelBatch batch, shorter;
  strip.at(std::span(&end, 1), batch);
  strip.at(std::span(&begin, 1), shorter);
  batch.set_difference(batch, shorter, 1);
  return batch[0];
}

/// What one edge of a strip adds, both sides of the plate: the two faces of a half plane, whose currents have opposite normals.
struct EdgeStrips {
  Complex radiated;
  Complex onwards;  // the current on the far edge, with the phase of what radiates from there
};

inline EdgeStrips both_sides(double source, bool hard, double mu, double length) {
  const double h = half_cosine_of(mu);
  const StripKernels lit = kernels_at(Strip(2.0, incidence_at(source), h), length);
  const StripKernels dark = kernels_at(Strip(2.0, incidence_at(2 * pi - source), h), length);
  if (!hard) return {lit.current.soft + dark.current.soft, 0.0};
  return {lit.current.hard - dark.current.hard, 2.0 * (lit.end - dark.end)};
}

inline constexpr int physical_optics = -1, untruncated_strips = 0;  // 1: strips that end with the face; 2, 3, ...: edges in a row

/// Far-field amplitude P about the centre of a strip of width w [wavelengths]; angles of source and observer from its plane.
inline Complex strip_amplitude(double w, double source, double observer, int order, bool hard) {
  const double k = 2 * pi, x = k * w, spread = std::cos(source) + std::cos(observer);
  Complex p = 2 * w * sinc(x * spread / 2) * (hard ? 1.0 : std::sin(source));
  for (const int edge : {0, 1}) {
    if (order == physical_optics) break;
    double mu = edge == 0 ? std::cos(observer) : -std::cos(observer);
    const Complex phase = std::polar(1.0, (edge == 0 ? -0.5 : 0.5) * x * spread);
    const double length = order == untruncated_strips ? std::numeric_limits<double>::infinity() : x;
    EdgeStrips strips = both_sides(edge == 0 ? source : pi - source, hard, mu, length);
    p += Complex(0, 2 / k) * strips.radiated * phase;
    Complex wave = 0.5 * phase * strips.onwards;  // half: incident and reflected wave are one at grazing
    for (int step = 2; step <= order && hard; ++step) {
      mu = -mu;
      strips = both_sides(0.0, true, mu, x);
      p += Complex(0, 2 / k) * strips.radiated * wave;
      wave *= 0.5 * strips.onwards;
    }
  }
  return k / 4 * (hard ? std::sin(observer) : -1.0) * p;
}

}  // namespace raytube::testing
