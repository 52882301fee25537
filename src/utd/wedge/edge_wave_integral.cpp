#include "utd/wedge/edge_wave_integral.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/erfc_ray.h"
#include "math/filon.h"

namespace raytube {

/// Some rays: their lengths, and sqrt(k rho sin beta0).
struct RowPoints {
  Reals path, root;
};

/// Waves and their slopes at these rays, as WaveSums has them.
struct RowWaves {
  Complexes value{}, outwards{}, around{};
};

namespace {

// How far past an end of the edge its waves are followed, as sqrt(k detour): they have faded below 0.01 there and are let fade to
// nothing, so that no path ends in a jump.
constexpr double faded = 3.0;
// Electrical distance from the edge below which the waves on a face no longer change.
constexpr double at_edge = 0.05;
// A rule takes in distances from the edge up to this ratio: waves change with their root.
constexpr double octaves = 8.0;
constexpr double slack = 1e-9;  // keeps a number of rules the same where the ratio is a power of that, whatever the rounding

double fading(double detour) {
  const double u = detour / (faded * faded), rest = std::max(1.0 - u * u * u * u, 0.0);
  return rest * rest;
}

// W' = 2jxW - 2 e^{j pi/4} / sqrt(pi). `share` is a wave's share of what happens at a corner, by its x^2 = X, and that of its
// slopes.
template <class Share>
RowWaves waves_at(const std::array<EdgeWaveTerm, 2>& terms, int each, const RowPoints& at, Share share) {
  const double constant = std::sqrt(2 / pi);
  RowWaves sum;
  for (int i = 0; i < each; ++i) {
    const EdgeWaveTerm& term = terms[i];
    Reals x;
    for (std::size_t lane = 0; lane < lanes; ++lane) x[lane] = term.rate * at.root[lane];
    const Complexes w = scaled_erfc(x);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const auto [part, slope_part] = share(lane, x[lane] * x[lane]);
      const double slope_re = -2 * x[lane] * w.im[lane] - constant, slope_im = 2 * x[lane] * w.re[lane] - constant;
      const double strength = part * term.strength, along = slope_part * term.strength * x[lane] / 2;
      const double turn = slope_part * term.strength * term.rate_slope * at.root[lane];
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

Complex product(const Complexes& a, const Complexes& b) {
  double re = 0.0, im = 0.0;
  for (std::size_t i = 0; i < lanes; ++i) {
    re += a.re[i] * b.re[i] - a.im[i] * b.im[i];
    im += a.re[i] * b.im[i] + a.im[i] * b.re[i];
  }
  return {re, im};
}

WaveSums sum_of(const RowWaves& waves, const Complexes& weights, const Complexes& by_path, Complex factor, double sin_cone) {
  return {factor * product(by_path, waves.value), factor / sin_cone * product(weights, waves.outwards),
          factor / sin_cone * product(weights, waves.around)};
}

Complexes times(const Complexes& a, const Reals& b) {
  Complexes result;
  for (std::size_t i = 0; i < lanes; ++i) {
    result.re[i] = a.re[i] * b[i];
    result.im[i] = a.im[i] * b[i];
  }
  return result;
}

// a conj(b) c
Complexes turned_back(const Complexes& a, const Complexes& b, const Complexes& c) {
  Complexes result;
  for (std::size_t i = 0; i < lanes; ++i) {
    const double re = a.re[i] * b.re[i] + a.im[i] * b.im[i], im = a.im[i] * b.re[i] - a.re[i] * b.im[i];
    result.re[i] = re * c.re[i] - im * c.im[i];
    result.im[i] = re * c.im[i] + im * c.re[i];
  }
  return result;
}

}  // namespace

// Where the way over the corner is longer than the ray by d = faded^2 / k: a quadratic equation.
double EdgeWaveIntegral::reach(double path, double k, double cosine, double sin_cone) {
  const double d = faded * faded / k, square = sin_cone * sin_cone;
  return (d * cosine + std::sqrt(d * d + 2 * d * path * square)) / square;
}

/// At the eight points of a rule: the rays, their waves, and beside a corner what these are multiplied with.
struct EdgeWaveIntegral::Samples {
  RowPoints at;
  RowWaves incident, reflected;
  bool beside_corner = false;
  Complexes turn{}, step{};  // e^{j detour}, W of its root
  double scale = 0.0;        // of the integral
  double sin_cone = 1.0;

  WaveIntegrals sum(const Complexes& rule, Complex phase) const {
    const Complexes weights = beside_corner ? turned_back(rule, turn, step) : rule, by_path = times(weights, at.path);
    const Complex factor = scale * phase;
    return {sum_of(incident, weights, by_path, factor, sin_cone), sum_of(reflected, weights, by_path, factor, sin_cone)};
  }
};

template <class Visit>
void EdgeWaveIntegral::visit_rays(const RayRow& row, double k, Visit visit) const {
  const double from = std::max(row.from, from_), to = std::min(row.to, to_);
  if (from < to) {
    const double unit = at_edge / k;
    const double near = std::max(row.path + row.path_rate * from, unit), far = std::max(row.path + row.path_rate * to, unit);
    const int parts = 1 + static_cast<int>(std::abs(std::log(far / near)) / std::log(octaves) + slack);
    double begin = from;
    for (int i = 1; i <= parts; ++i) {
      const double path = near * std::pow(far / near, static_cast<double>(i) / parts);
      const double end = i == parts ? to : std::clamp((path - row.path) / row.path_rate, begin, to);
      visit(RowStretch{begin, end});
      begin = end;
    }
  }
}

template <class Visit>
void EdgeWaveIntegral::visit_beside_corner(const RayRow& row, double k, double corner, double inwards, Visit visit) const {
  if (!std::isfinite(corner)) return;
  const auto path_at = [&](double arc_length) { return std::max(row.path + row.path_rate * arc_length, 0.0); };
  const double longest = std::max(path_at(row.from), path_at(row.to));
  const double path = path_at(std::clamp(corner, row.from, row.to));
  for (const double side : {-1.0, 1.0}) {
    const double way = side * inwards, far = reach(longest, k, way * cos_cone_, sin_cone_);
    const double near = std::min(reach(path, k, way * cos_cone_, sin_cone_), far);
    // The wave over the corner turns by faded^2 against the ray's, most of it in the outer half.
    const std::array<double, 4> parts{0.0, near / 2, near, far};
    for (std::size_t i = 1; i < parts.size(); ++i) {
      const double start = corner + way * parts[i - 1], end = corner + way * parts[i];
      const double low = std::max(row.from, std::min(start, end)), high = std::min(row.to, std::max(start, end));
      if (low < high) visit(RowStretch{low, high, corner, side});
    }
  }
}

void EdgeWaveIntegral::add(const RayRow& row, const RowStretch& stretch, double k, WaveIntegrals& sum) const {
  const Complexes weights = FilonRule::get().weights(k * row.phase_rate * stretch.half());
  const Complex phase = std::polar(1.0, k * (row.phase + row.phase_rate * stretch.middle()));
  const WaveIntegrals part = sampled(row, stretch, k).sum(weights, phase);
  sum.incident += part.incident;
  sum.reflected += part.reflected;
}

WaveIntegrals EdgeWaveIntegral::over(const RayRow& row, double k) const {
  WaveIntegrals sum;
  const auto add_to_sum = [&](const RowStretch& stretch) { add(row, stretch, k, sum); };
  visit_rays(row, k, add_to_sum);
  visit_beside_corner(row, k, corners_[0], 1.0, add_to_sum);
  visit_beside_corner(row, k, corners_[1], -1.0, add_to_sum);
  return sum;
}

WaveIntegrals EdgeWaveIntegral::beside_corners(const RayRow& row, double k) const {
  WaveIntegrals sum;
  const auto add_to_sum = [&](const RowStretch& stretch) { add(row, stretch, k, sum); };
  visit_beside_corner(row, k, corners_[0], 1.0, add_to_sum);
  visit_beside_corner(row, k, corners_[1], -1.0, add_to_sum);
  return sum;
}

std::vector<RowStretch> EdgeWaveIntegral::stretches(const RayRow& row, double k) const {
  std::vector<RowStretch> all;
  visit_rays(row, k, [&](const RowStretch& stretch) { all.push_back(stretch); });
  return all;
}

WaveIntegrals EdgeWaveIntegral::whole(const RayRow& row, const RowStretch& stretch, double k) const {
  return sampled(row, stretch, k).sum(FilonRule::get().weights(k * row.phase_rate * stretch.half()), 1.0);
}

EdgeWaveIntegral::Ends EdgeWaveIntegral::ends(const RayRow& row, const RowStretch& stretch, double k) const {
  const FilonRule::Ends weights = FilonRule::get().end_weights(k * row.phase_rate * stretch.half());
  const Samples samples = sampled(row, stretch, k);
  return {samples.sum(weights.begin, 1.0), samples.sum(weights.end, 1.0)};
}

EdgeWaveIntegral::Samples EdgeWaveIntegral::sampled(const RayRow& row, const RowStretch& stretch, double k) const {
  if (stretch.side != 0.0) return beside_corner(row, stretch, k);
  const FilonRule& rule = FilonRule::get();
  Samples samples;
  samples.scale = stretch.half();
  samples.sin_cone = sin_cone_;
  for (std::size_t i = 0; i < lanes; ++i) {
    samples.at.path[i] = std::max(row.path + row.path_rate * (stretch.middle() + stretch.half() * rule.at[i]), 0.0);
    samples.at.root[i] = sin_cone_ * std::sqrt(k * samples.at.path[i]);
  }
  const auto all = [](std::size_t, double) { return std::pair(1.0, 1.0); };
  samples.incident = waves_at(terms_.incident, terms_.each, samples.at, all);
  samples.reflected = waves_at(terms_.reflected, terms_.each, samples.at, all);
  return samples;
}

EdgeWaveIntegral::Samples EdgeWaveIntegral::beside_corner(const RayRow& row, const RowStretch& stretch, double k) const {
  const FilonRule& rule = FilonRule::get();
  Samples samples;
  samples.beside_corner = true;
  samples.scale = -stretch.side / 2 * stretch.half();
  samples.sin_cone = sin_cone_;
  RowPoints& at = samples.at;
  Reals detour, x;
  for (std::size_t i = 0; i < lanes; ++i) {
    const double arc_length = stretch.middle() + stretch.half() * rule.at[i], beyond = arc_length - stretch.corner;
    at.path[i] = std::max(row.path + row.path_rate * arc_length, 0.0);
    at.root[i] = sin_cone_ * std::sqrt(k * at.path[i]);
    const double along = beyond + at.path[i] * cos_cone_, across = at.path[i] * sin_cone_;
    const double both = std::sqrt(along * along + across * across) + at.path[i];
    const double longer = both > 0.0 ? beyond * (along + at.path[i] * cos_cone_) / both : 0.0;  // over the corner than the ray
    detour[i] = both > 0.0 ? std::max(k * beyond * (beyond - cos_cone_ * longer) / both, 0.0) : 0.0;
    x[i] = std::sqrt(detour[i]);
  }
  const auto share = [&](std::size_t lane, double z2) {
    const double both = z2 + detour[lane], own = both > 0.0 ? z2 / both : 1.0, faded = fading(detour[lane]);
    return std::pair(faded * own, faded * own * own);
  };
  samples.turn = unit_phasors(detour);
  samples.step = scaled_erfc(x);
  samples.incident = waves_at(terms_.incident, terms_.each, at, share);
  samples.reflected = waves_at(terms_.reflected, terms_.each, at, share);
  return samples;
}

}  // namespace raytube
