#include "output/compare/curve_lag.h"

#include <algorithm>
#include <cmath>

#include "output/compare/error_measures.h"

namespace raytube {

namespace {

constexpr int most_steps = 200;
constexpr std::size_t least_points = 5;
constexpr double least_correlation = 0.5;

struct Extent {
  double step, longest;
};

Extent extent_of(const std::vector<CurvePair>& pairs) {
  std::vector<double> steps;
  double longest = 0.0;
  for (const CurvePair& pair : pairs) {
    for (std::size_t i = 1; i < pair.x.size(); ++i)
      if (pair.x[i] > pair.x[i - 1]) steps.push_back(pair.x[i] - pair.x[i - 1]);
    longest = std::max(longest, pair.x.back() - pair.x.front());
  }
  return {steps.size() + 1 < least_points ? 0.0 : quantile(steps, 0.5), longest};
}

// Correlation of a(x) with b(x - shift) where both exist.
double shifted_correlation(const std::vector<CurvePair>& pairs, double shift, double step) {
  std::vector<double> first, second;
  for (const auto& [x, a, b] : pairs) {
    const double slack = 1e-6 * step;  // a shift by whole steps must not lose the ends to rounding
    for (std::size_t i = 0, at = 1; i < x.size(); ++i) {
      const double y = x[i] - shift;
      if (x.size() < 2 || y < x.front() - slack || y > x.back() + slack) continue;
      while (at + 1 < x.size() && x[at] < y) ++at;
      const double width = x[at] - x[at - 1], t = width > 0.0 ? std::clamp((y - x[at - 1]) / width, 0.0, 1.0) : 0.0;
      first.push_back(a[i]);
      second.push_back(b[at - 1] + t * (b[at] - b[at - 1]));
    }
  }
  return first.size() < least_points ? ErrorMeasures::undefined : correlation(first, second);
}

}  // namespace

double best_lag(const std::vector<CurvePair>& pairs) {
  const auto [step, longest] = extent_of(pairs);
  if (!(step > 0.0)) return ErrorMeasures::undefined;
  const int most = static_cast<int>(std::min<double>(most_steps, longest / 4.0 / step));
  std::vector<double> c;
  for (int m = -most; m <= most; ++m) c.push_back(shifted_correlation(pairs, m * step, step));
  int best = most;  // no shift, unless another one is better
  for (int i = 0; i < static_cast<int>(c.size()); ++i)
    if (c[i] > c[best]) best = i;
  if (!(c[best] >= least_correlation) || best == 0 || best == 2 * most) return ErrorMeasures::undefined;
  const double curvature = c[best - 1] - 2.0 * c[best] + c[best + 1];
  const double fraction = curvature < 0.0 ? 0.5 * (c[best - 1] - c[best + 1]) / curvature : 0.0;
  return step * (best - most + fraction);
}

}  // namespace raytube
