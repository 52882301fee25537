#include "utd/wedge/edge_wave_integral.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/erfc_ray.h"
#include "math/filon.h"
#include "utd/wedge/rounding_guard.h"

namespace raytube {

namespace {

// Sum of a b over all lanes, those of both halves side by side.
[[gnu::always_inline]] inline Complex product(const Complexes& a, const Complexes& b) {
  constexpr std::size_t half = lanes / 2;
  static_assert(half == 4);
  double re[half], im[half];
  for (std::size_t i = 0; i < half; ++i) {
    const std::size_t other = i + half;
    re[i] = (a.re[i] * b.re[i] - a.im[i] * b.im[i]) + (a.re[other] * b.re[other] - a.im[other] * b.im[other]);
    im[i] = (a.re[i] * b.im[i] + a.im[i] * b.re[i]) + (a.re[other] * b.im[other] + a.im[other] * b.re[other]);
  }
  return {(re[0] + re[2]) + (re[1] + re[3]), (im[0] + im[2]) + (im[1] + im[3])};
}

WaveSums sum_of(const edge_row::Waves& waves, const Complexes& weights, const Complexes& by_path, Complex factor,
                double sin_cone) {
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

// conj(a) b
Complexes turned_back(const Complexes& a, const Complexes& b) {
  Complexes result;
  for (std::size_t i = 0; i < lanes; ++i) {
    result.re[i] = a.re[i] * b.re[i] + a.im[i] * b.im[i];
    result.im[i] = a.re[i] * b.im[i] - a.im[i] * b.re[i];
  }
  return result;
}

Complexes times(const Complexes& a, const Complexes& b) {
  Complexes result;
  for (std::size_t i = 0; i < lanes; ++i) {
    result.re[i] = a.re[i] * b.re[i] - a.im[i] * b.im[i];
    result.im[i] = a.re[i] * b.im[i] + a.im[i] * b.re[i];
  }
  return result;
}

}  // namespace

/// At the eight points of a rule: the rays, their waves, and beside a corner what these are multiplied with.
struct EdgeWaveIntegral::Samples {
  Reals path;  // lengths of rays
  edge_row::BothWaves waves;
  double scale;  // size of the integral
  double sin_cone;
  bool beside_corner = false;
  Complexes step{};  // e^{-j detour} W of its root

  WaveIntegrals sum(const Complexes& rule, Complex phase) const {
    const Complexes weights = beside_corner ? times(rule, step) : rule, by_path = times(weights, path);
    const Complex factor = scale * phase;
    return {sum_of(waves.incident, weights, by_path, factor, sin_cone),
            sum_of(waves.reflected, weights, by_path, factor, sin_cone)};
  }
};

template <class Visit>
void EdgeWaveIntegral::visit_rays(const RayRow& row, double k, Visit visit) const {
  const double from = std::max(row.from, from_), to = std::min(row.to, to_);
  if (from < to) {
    const double unit = edge_row::least_distance / k;
    const double near = std::max(row.path + row.path_rate * from, unit), far = std::max(row.path + row.path_rate * to, unit);
    // The number of rules is the same where the ratio is a power of `most_ratio`, whatever the rounding.
    const int parts = 1 + static_cast<int>(std::abs(std::log(far / near)) / std::log(edge_row::most_ratio) + rounding_guard);
    const double ratio = std::pow(far / near, 1.0 / parts);
    double begin = from, path = near;
    for (int i = 1; i <= parts; ++i) {
      path *= ratio;
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
  const edge_row::EndRay end{corner, cos_cone_, sin_cone_, path_at(std::clamp(corner, row.from, row.to)),
                             std::max(path_at(row.from), path_at(row.to))};
  edge_row::visit_beside(end, inwards, row.from, row.to, k, visit);
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
  const double middle = stretch.middle(), half = stretch.half(), sin_cone = sin_cone_;
  const RayRow along = row;  // what the lanes read does not change as they are written
  Reals path, root;          // root: sqrt(k rho sin beta0)
  for (std::size_t i = 0; i < lanes; ++i) {
    path[i] = std::max(along.path + along.path_rate * (middle + half * rule.at[i]), 0.0);
    root[i] = sin_cone * std::sqrt(k * path[i]);
  }
  const auto all = [](std::size_t, double) { return std::pair(1.0, 1.0); };
  return {path, edge_row::both_waves(terms_, root, all), half, sin_cone};
}

EdgeWaveIntegral::Samples EdgeWaveIntegral::beside_corner(const RayRow& row, const RowStretch& stretch, double k) const {
  const FilonRule& rule = FilonRule::get();
  const double middle = stretch.middle(), half = stretch.half(), corner = stretch.corner;
  const double sin_cone = sin_cone_, cos_cone = cos_cone_;
  const RayRow all = row;  // what the lanes read does not change as they are written
  Reals path, root, detour, x;
  for (std::size_t i = 0; i < lanes; ++i) {
    const double arc_length = middle + half * rule.at[i], beyond = arc_length - corner;
    path[i] = std::max(all.path + all.path_rate * arc_length, 0.0);
    root[i] = sin_cone * std::sqrt(k * path[i]);
    const double along = beyond + path[i] * cos_cone, across = path[i] * sin_cone;
    const double both = std::sqrt(along * along + across * across) + path[i];
    const double longer =
        both > 0.0 ? beyond * (along + path[i] * cos_cone) / both : 0.0;  // the way over the corner is than the ray
    detour[i] = both > 0.0 ? std::max(k * beyond * (beyond - cos_cone * longer) / both, 0.0) : 0.0;
    x[i] = std::sqrt(detour[i]);
  }
  const auto share = [&](std::size_t lane, double z2) { return edge_row::shares_at_end(z2, detour[lane]); };
  return {path, edge_row::both_waves(terms_, root, share),        -stretch.side / 2 * half, sin_cone,
          true, turned_back(unit_phasors(detour), scaled_erfc(x))};
}

}  // namespace raytube
