#include "sbr/solid/phase_mean.h"

#include <cmath>
#include <utility>

namespace raytube {

namespace {

constexpr Complex j{0.0, 1.0};

// sum_p (j y)^p / (p + 1)!, or its closed form.
Complex segment_mean(Complex a, Complex b) {
  const Complex y = 0.5 * (b - a);
  const Complex sinc_y = std::abs(y) < 1e-3 ? 1.0 - y * y / 6.0 : std::sin(y) / y;
  return std::exp(j * 0.5 * (a + b)) * sinc_y;
}

// 2 sum_p j^p h_p / (p + 2)!, h_p the complete homogeneous polynomials about the mean.
Complex series(const std::array<Complex, 3>& x) {
  constexpr int terms = 14;
  const Complex mean = (x[0] + x[1] + x[2]) / 3.0, a = x[0] - mean, b = x[1] - mean, c = x[2] - mean;
  const Complex e2 = a * b + b * c + c * a, e3 = a * b * c;
  Complex before[2] = {0.0, 0.0}, h = 1.0, sum = 1.0, factor = 1.0;
  for (int p = 1; p < terms; ++p) {
    const Complex next = -e2 * before[1] + e3 * before[0];
    before[0] = before[1], before[1] = h, h = next;
    factor *= j / (p + 2.0);
    sum += factor * next;
  }
  return std::exp(j * mean) * sum;
}

}  // namespace

Complex triangle_phase_mean(std::array<Complex, 3> x) {
  const auto apart = [&](int a, int b) { return std::abs(x[a] - x[b]); };
  if (apart(0, 1) > apart(0, 2)) std::swap(x[1], x[2]);
  if (apart(1, 2) > apart(0, 2)) std::swap(x[0], x[1]);
  const Complex spread = x[2] - x[0];
  if (std::abs(spread) < 0.5) return series(x);
  return Complex(0.0, -2.0) / spread * (segment_mean(x[1], x[2]) - segment_mean(x[0], x[1]));
}

}  // namespace raytube
