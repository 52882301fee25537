#include <gtest/gtest.h>

#include <vector>

#include "utd/wedge_coefficients.h"

namespace raytube {
namespace {

constexpr double k = 2 * pi;

/// Exact field of a unit plane wave around a wedge in one angle psi = phi -+ phi' (Macdonald 1902; Bowman, Senior and Uslenghi
/// 1969): v = (1/n) sum eps_m j^{m/n} J_{m/n}(k rho) cos(m psi/n). Soft: v(phi - phi') - v(phi + phi'), hard: the sum.
class WedgeSeries {
 public:
  WedgeSeries(double n, double k_rho) : n_(n) {
    const int last = static_cast<int>(std::ceil(n * (k_rho + 12 * std::cbrt(k_rho) + 25)));
    for (int m = 0; m <= last; ++m)
      terms_.push_back((m == 0 ? 1.0 : 2.0) / n * std::cyl_bessel_j(m / n, k_rho) * std::polar(1.0, pi * m / n / 2));
  }

  Complex operator()(double psi) const {
    Complex sum = 0.0;
    for (std::size_t m = 0; m < terms_.size(); ++m) sum += terms_[m] * std::cos(static_cast<double>(m) * psi / n_);
    return sum;
  }

 private:
  double n_;
  std::vector<Complex> terms_;
};

/// Geometrical optics: one plane wave per image that the observer sees, half of it exactly on its boundary (the tie rule).
Complex rays(double n, double psi, double k_rho) {
  Complex sum = 0.0;
  const int images = static_cast<int>(std::ceil(2 / n)) + 2;
  for (int image = -images; image <= images; ++image) {
    const double distance = std::abs(psi - 2 * pi * n * image) - pi;
    const double weight = std::abs(distance) < 1e-12 ? 0.5 : distance < 0 ? 1.0 : 0.0;
    sum += std::polar(weight, k_rho * std::cos(psi - 2 * pi * n * image));
  }
  return sum;
}

/// Larger of the soft and hard errors of rays + diffracted ray at distance rho from the edge.
double total_field_error(const WedgeSeries& exact, double n, double source, double observer, double k_rho) {
  const double rho = k_rho / k;
  const WedgeCoefficients d = wedge_coefficients({n, source, observer, 1.0, rho}, k);
  const Complex spread = std::polar(1 / std::sqrt(rho), -k_rho);
  const double minus = observer - source, plus = observer + source;
  const Complex go_minus = rays(n, minus, k_rho), go_plus = rays(n, plus, k_rho);
  const Complex exact_minus = exact(minus), exact_plus = exact(plus);
  return std::max(std::abs(go_minus - go_plus + d.soft * spread - (exact_minus - exact_plus)),
                  std::abs(go_minus + go_plus + d.hard * spread - (exact_minus + exact_plus)));
}

/// Observers all round, and beside and on every boundary.
std::vector<double> observers(double n, double source) {
  std::vector<double> result;
  for (int i = 0; i <= 400; ++i) result.push_back(n * pi * i / 400);
  for (const double boundary : {pi - source, pi + source, 2 * n * pi - pi - source})
    for (const double step : {-1e-5, -1e-9, 0.0, 1e-9, 1e-5}) result.push_back(std::clamp(boundary + step, 0.0, n * pi));
  return result;
}

double worst_error(double n, double k_rho) {
  const WedgeSeries exact(n, k_rho);
  double worst = 0.0;
  for (const double share : {0.03, 0.13, 0.31, 0.5, 0.67})
    for (const double observer : observers(n, share * n * pi))
      worst = std::max(worst, total_field_error(exact, n, share * n * pi, observer, k_rho));
  return worst;
}

TEST(WedgeCoefficients, HalfPlaneAndRightCornerAreExact) {
  // n = 2 is Sommerfeld's exact solution, n = 1/2 has no diffraction at all. 3e-12: sums of up to 360 Bessel functions.
  for (const double n : {2.0, 0.5})
    for (const double k_rho : {1.0, 5.0, 20.0, 100.0})
      EXPECT_LE(worst_error(n, k_rho), 3e-12) << "n " << n << ", k rho " << k_rho;
}

TEST(WedgeCoefficients, TotalFieldAgreesWithTheExactSeries) {
  struct Row {
    double n;
    double error[4];  // k rho = 1, 5, 20, 100
  };
  // Size of the asymptotic remainder, found with an independent implementation on 2000 observers; 5 % are added for rounding
  // of the figures. A wrong sign, boundary or tie exceeds it by orders of magnitude.
  const Row rows[] = {{1.75, {1.9e-2, 5.3e-3, 1.25e-3, 2.3e-4}},
                      {1.5, {3.2e-2, 5.8e-3, 1.35e-3, 2.7e-4}},
                      {1.25, {4.7e-2, 1.1e-2, 2.1e-3, 3.3e-4}},
                      {1.02, {9.4e-3, 3.7e-3, 1.3e-3, 4.2e-4}},
                      {0.75, {9.0e-2, 2.2e-2, 4.1e-3, 6.5e-4}}};
  const double distances[] = {1.0, 5.0, 20.0, 100.0};
  for (const Row& row : rows)
    for (int i = 0; i < 4; ++i)
      EXPECT_LE(worst_error(row.n, distances[i]), 1.05 * row.error[i]) << "n " << row.n << ", k rho " << distances[i];
}

TEST(WedgeCoefficients, BoundaryExpansionJoinsTheFullForm) {
  // Either side of the switch at 1e-7 rad: the jump is the change over 2e-10 rad, slope about 4 k L, plus 1e-9 relative.
  const double source = 1.0, length = 100.0;
  const WedgeCoefficients inside = wedge_coefficients({1.5, source, pi + source + 0.999e-7, 1.0, length}, k);
  const WedgeCoefficients outside = wedge_coefficients({1.5, source, pi + source + 1.001e-7, 1.0, length}, k);
  EXPECT_LE(std::abs(inside.soft - outside.soft), 1e-6 * std::abs(outside.soft));
  EXPECT_LE(std::abs(inside.hard - outside.hard), 1e-6 * std::abs(outside.hard));
}

TEST(WedgeCoefficients, ObliqueIncidenceScalesWithTheCone) {
  const WedgeCoefficients normal = wedge_coefficients({1.5, 1.0, 3.0, 1.0, 7.0}, k);
  const WedgeCoefficients oblique = wedge_coefficients({1.5, 1.0, 3.0, 0.5, 7.0}, k);
  EXPECT_LE(std::abs(oblique.soft - 2.0 * normal.soft), 1e-15);
  EXPECT_LE(std::abs(oblique.hard - 2.0 * normal.hard), 1e-15);
}

}  // namespace
}  // namespace raytube
