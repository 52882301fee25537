#include "utd/corner/radial_wave.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace raytube {

namespace {

// Zones by the angle from the point opposite to the source [rad]: the first one, and `steps` more, of which the last ends 0.2 rad
// before the source.
constexpr double first_zone = 0.3, zone_width = 0.08;
constexpr int steps = 33;

double cosine_at(double zones) { return -std::cos(first_zone + zones * zone_width); }

/// Cosines of the zones' ends and, from the second on, of their middles.
struct Zones {
  std::array<double, steps + 1> end, middle;
  Zones() {
    for (int zone = 0; zone <= steps; ++zone) end[zone] = cosine_at(zone), middle[zone] = cosine_at(zone - 0.5);
  }
  int of(double cosine) const {
    return static_cast<int>(std::ranges::lower_bound(end.begin(), end.end() - 1, cosine) - end.begin());
  }
};
const Zones zones;

double middle_of(int zone) { return zones.middle[zone]; }

/// Coefficients of the solution of Legendre's equation around c0, from its value and slope there: the equation
/// (1 - c^2) g'' - 2 c g' + (nu^2 - 1/4) g = 0, power by power.
template <std::size_t n>
std::array<Complex, n> taylor(Complex value, Complex slope, double c0, Complex eigenvalue) {
  std::array<Complex, n> a{value, slope};
  const double s = 1.0 - c0 * c0;
  for (std::size_t m = 0; m + 2 < n; ++m) {
    const auto i = static_cast<double>(m);
    a[m + 2] = (2.0 * c0 * (i + 1) * (i + 1) * a[m + 1] + (i * (i + 1) - eigenvalue) * a[m]) / (s * (i + 1) * (i + 2));
  }
  return a;
}

}  // namespace

Complex digamma(Complex z) {
  Complex sum = 0.0;
  for (; z.real() < 12.0; z += 1.0) sum -= 1.0 / z;
  const Complex q = 1.0 / (z * z);
  return sum + std::log(z) - 0.5 / z - q * (1.0 / 12 - q * (1.0 / 120 - q * (1.0 / 252 - q * (1.0 / 240 - q / 132.0))));
}

RadialWave::RadialWave() : zones_(steps + 1), logarithmic_{}, rest_{} {}

RadialWave::RadialWave(Complex nu) : RadialWave() {
  const Complex a = 0.5 - nu, b = 0.5 + nu, eigenvalue = nu * nu - 0.25, scale = 0.25 / std::cos(pi * nu);
  // Hypergeometric series around both poles (Abramowitz & Stegun 1964, 8.1.2 and 15.3.10).
  Complex c = 1.0, psi = 2.0 * digamma(b) - pi * std::tan(pi * nu) + 2.0 * std::numbers::egamma;
  double power = 1.0;
  for (int m = 0; m < terms; ++m, power *= 2.0) {
    zones_[0][m] = scale * c / power;
    logarithmic_[m] = c * (-0.25 / pi);
    rest_[m] = psi * c * (-0.25 / pi);
    const double i = m;
    psi += 1.0 / (a + i) + 1.0 / (b + i) - 2.0 / (i + 1);
    c *= (a + i) * (b + i) / ((i + 1) * (i + 1));
  }
  constexpr std::size_t many = 24;
  double from = -std::cos(first_zone);
  Values known = evaluate(zones_[0], 1.0 + from);
  const auto follow = [&](double to) {
    const auto series = taylor<many>(known.value, known.slope, from, eigenvalue);
    known = {};
    for (std::size_t m = many; m-- > 0;) {
      known.slope = known.slope * (to - from) + known.value;
      known.value = known.value * (to - from) + series[m];
    }
    from = to;
  };
  for (int zone = 1; zone <= steps; ++zone) {
    follow(middle_of(zone));
    zones_[zone] = taylor<terms>(known.value, known.slope, from, eigenvalue);
  }
}

void RadialWave::add(Complex factor, const RadialWave& other) {
  const auto add_to = [factor](Polynomial& sum, const Polynomial& part) {
    for (int m = 0; m < terms; ++m) sum[m] += factor * part[m];
  };
  for (std::size_t zone = 0; zone < zones_.size(); ++zone) add_to(zones_[zone], other.zones_[zone]);
  add_to(logarithmic_, other.logarithmic_);
  add_to(rest_, other.rest_);
}

RadialWave::Values RadialWave::evaluate(const Polynomial& p, double x) {
  Values result{};
  for (int m = terms; m-- > 0;) {
    result.bend = result.bend * x + result.slope;
    result.slope = result.slope * x + result.value;
    result.value = result.value * x + p[m];
  }
  result.bend *= 2.0;
  return result;
}

RadialWave::Values RadialWave::near_source(double cosine) const {
  const double t = 0.5 * (1.0 - cosine), log = std::log(t);
  const Values a = evaluate(logarithmic_, t), b = evaluate(rest_, t);
  const Complex slope = a.slope * log + a.value / t + b.slope;
  const Complex bend = a.bend * log + 2.0 * a.slope / t - a.value / (t * t) + b.bend;
  return {a.value * log + b.value, -0.5 * slope, 0.25 * bend};
}

RadialWave::Values RadialWave::at(double cosine) const {
  if (cosine > zones.end.back()) return near_source(cosine);
  const int zone = zones.of(cosine);
  return evaluate(zones_[zone], zone == 0 ? 1.0 + cosine : cosine - middle_of(zone));
}

// ln(t) = 2 ln(theta) - 2 ln(2) there.
Complex RadialWave::smooth_at_source() const { return rest_[0] - 2.0 * std::numbers::ln2 * logarithmic_[0]; }

}  // namespace raytube
