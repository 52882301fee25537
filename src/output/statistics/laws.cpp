#include "output/statistics/laws.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

namespace {

constexpr std::size_t least_levels = 10;
constexpr double least_log_spread = 1e-9;  // less is rounding
constexpr double undefined_value = std::numeric_limits<double>::quiet_NaN();
const double db_of_one = 10.0 / std::log(10.0);  // dB of a natural logarithm of 1

double square_metres_of(double dbsm) { return std::pow(10.0, dbsm / 10.0); }

// sum x^n / (k (k + 1) ... (k + n)), for x < k + 1.
double gamma_series(double k, double x) {
  double term = 1.0 / k, sum = term;
  for (double n = 1.0; term > 1e-17 * sum; ++n) sum += term *= x / (k + n);
  return sum * std::exp(k * std::log(x) - x - std::lgamma(k));
}

// 1 - P as a continued fraction, from its front (Lentz 1976), for x >= k + 1.
double gamma_fraction(double k, double x) {
  double b = x + 1.0 - k, c = 1e300, d = 1.0 / b, fraction = d;
  for (double n = 1.0; n < 1e6; ++n) {
    const double a = n * (k - n);
    b += 2.0;
    d = 1.0 / (a * d + b);
    c = b + a / c;
    fraction *= c * d;
    if (std::abs(c * d - 1.0) < 1e-15) break;
  }
  return fraction * std::exp(k * std::log(x) - x - std::lgamma(k));
}

// The largest difference between the share of ascending levels below a level and the law's (Kolmogorov 1933).
double ks_distance(const LawFit& law, const std::vector<double>& ascending) {
  const double count = static_cast<double>(ascending.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < ascending.size(); ++i) {
    const double below = law.below(ascending[i]), rank = static_cast<double>(i);
    largest = std::max({largest, below - rank / count, (rank + 1.0) / count - below});
  }
  return largest;
}

struct Moments {
  double mean = 0.0, middle_db = 0.0, spread_db = 0.0;
};

Moments moments_of(const std::vector<double>& levels) {
  const double count = static_cast<double>(levels.size());
  Moments m;
  for (const double level : levels) m.mean += square_metres_of(level) / count, m.middle_db += level / count;
  for (const double level : levels) m.spread_db += (level - m.middle_db) * (level - m.middle_db) / count;
  m.spread_db = std::sqrt(m.spread_db);
  return m;
}

// The mean of a log-normal law is exp(mu + spread^2 / 2), in natural logarithms.
LawFit log_normal_law(const Moments& m) {
  const double mu = m.middle_db / db_of_one, spread = m.spread_db / db_of_one;
  return {Law::log_normal, std::exp(mu + 0.5 * spread * spread), undefined_value, m.middle_db, m.spread_db, 0.0};
}

LawFit gamma_law(Law law, double mean, double shape) { return {law, mean, shape, undefined_value, undefined_value, 0.0}; }

}  // namespace

double digamma(double x) {
  double shift = 0.0;
  for (; x < 10.0; ++x) shift -= 1.0 / x;
  const double y = 1.0 / (x * x);
  return shift + std::log(x) - 0.5 / x - y * (1.0 / 12.0 - y * (1.0 / 120.0 - y * (1.0 / 252.0 - y * (1.0 / 240.0 - y / 132.0))));
}

double gamma_below(double k, double x) {
  if (!(x > 0.0)) return 0.0;
  return x < k + 1.0 ? gamma_series(k, x) : 1.0 - gamma_fraction(k, x);
}

// ln k - psi(k) falls from infinity to 0, about as 1 / (2 k): bisection in ln k.
double likeliest_shape(double log_spread) {
  double low = 1e-3, high = 1.0 / log_spread + 1.0;
  for (int i = 0; i < 200 && high - low > 1e-14 * high; ++i) {
    const double k = std::sqrt(low * high);
    (std::log(k) - digamma(k) > log_spread ? low : high) = k;
  }
  return std::sqrt(low * high);
}

double LawFit::below(double dbsm) const {
  if (law == Law::log_normal) return 0.5 * std::erfc((middle_db - dbsm) / (std::sqrt(2.0) * spread_db));
  return gamma_below(shape, shape * square_metres_of(dbsm) / mean_m2);
}

std::vector<LawFit> fitted_laws(std::span<const double> dbsm) {
  std::vector<double> levels;
  for (const double level : dbsm)
    if (std::isfinite(level)) levels.push_back(level);
  if (levels.size() < least_levels) return {};
  std::ranges::sort(levels);
  const Moments m = moments_of(levels);
  const double log_spread = std::log(m.mean) - m.middle_db / db_of_one;
  if (!(log_spread > least_log_spread)) return {};
  std::vector<LawFit> laws = {gamma_law(Law::swerling_1, m.mean, 1.0), gamma_law(Law::swerling_3, m.mean, 2.0),
                              gamma_law(Law::chi_square, m.mean, likeliest_shape(log_spread)), log_normal_law(m)};
  for (LawFit& law : laws) law.distance = ks_distance(law, levels);
  return laws;
}

const LawFit& nearest_law(const std::vector<LawFit>& laws) { return *std::ranges::min_element(laws, {}, &LawFit::distance); }

}  // namespace raytube
