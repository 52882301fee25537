#include "utd/corner/radial_wave.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace raytube {

namespace {

// Zones by the angle from the point opposite to the source [rad]: the first one, and `steps` more, of which the last ends 0.2 rad
// before the source.
constexpr double first_zone = 0.3, zone_width = 0.08;
constexpr int steps = RadialWave::zones - 1;

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
const Zones zone_cosines;

double middle_of(int zone) { return zone_cosines.middle[zone]; }

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

RadialWave::Values evaluate(const RadialWave::Polynomial& p, double x) {
  RadialWave::Values result{};
  for (int m = RadialWave::terms; m-- > 0;) {
    result.bend = result.bend * x + result.slope;
    result.slope = result.slope * x + result.value;
    result.value = result.value * x + p[m];
  }
  result.bend *= 2.0;
  return result;
}

}  // namespace

Complex digamma(Complex z) {
  Complex sum = 0.0;
  for (; z.real() < 12.0; z += 1.0) sum -= 1.0 / z;
  const Complex q = 1.0 / (z * z);
  return sum + std::log(z) - 0.5 / z - q * (1.0 / 12 - q * (1.0 / 120 - q * (1.0 / 252 - q * (1.0 / 240 - q / 132.0))));
}

RadialWave::RadialWave(Complex nu) {
  const Complex a = 0.5 - nu, b = 0.5 + nu, eigenvalue = nu * nu - 0.25, scale = 0.25 / std::cos(pi * nu);
  // Hypergeometric series around both poles (Abramowitz & Stegun 1964, 8.1.2 and 15.3.10).
  Complex c = 1.0, psi = 2.0 * digamma(b) - pi * std::tan(pi * nu) + 2.0 * std::numbers::egamma;
  double power = 1.0;
  for (int m = 0; m < terms; ++m, power *= 2.0) {
    coefficients_[0][m] = scale * c / power;
    coefficients_[logarithmic][m] = c * (-0.25 / pi);
    coefficients_[rest][m] = psi * c * (-0.25 / pi);
    const double i = m;
    psi += 1.0 / (a + i) + 1.0 / (b + i) - 2.0 / (i + 1);
    c *= (a + i) * (b + i) / ((i + 1) * (i + 1));
  }
  constexpr std::size_t many = 24;
  double from = -std::cos(first_zone);
  Values known = evaluate(coefficients_[0], 1.0 + from);
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
    coefficients_[zone] = taylor<terms>(known.value, known.slope, from, eigenvalue);
  }
}

RadialWave::Place RadialWave::place(double cosine) {
  if (cosine > zone_cosines.end.back()) return {logarithmic, 0.5 * (1.0 - cosine)};
  const int zone = zone_cosines.of(cosine);
  return {zone, zone == 0 ? 1.0 + cosine : cosine - middle_of(zone)};
}

double RadialWave::reach(int polynomial) {
  if (polynomial >= zones) return 0.5 * (1.0 - zone_cosines.end.back());
  return polynomial == 0 ? 1.0 + zone_cosines.end[0] : 0.5 * (zone_cosines.end[polynomial] - zone_cosines.end[polynomial - 1]);
}

RadialWave::Values RadialWave::at(double cosine) const {
  const Place place = RadialWave::place(cosine);
  const Values a = evaluate(coefficients_[place.polynomial], place.x);
  if (!place.near_source()) return a;
  const double t = place.x, log = std::log(t);
  const Values b = evaluate(coefficients_[rest], t);
  const Complex slope = a.slope * log + a.value / t + b.slope;
  const Complex bend = a.bend * log + 2.0 * a.slope / t - a.value / (t * t) + b.bend;
  return {a.value * log + b.value, -0.5 * slope, 0.25 * bend};
}

// ln(t) = 2 ln(theta) - 2 ln(2) there.
Complex RadialWave::smooth_at_source() const {
  return coefficients_[rest][0] - 2.0 * std::numbers::ln2 * coefficients_[logarithmic][0];
}

}  // namespace raytube
