#include "utd/fock/edge_factors.h"

#include <numbers>
#include <vector>

namespace raytube {

namespace {

// The table has so many values per unit of xi, and ends at this xi.
constexpr int per_unit = 128, table_end = 20;
// The xi at which the next term of the series is 1e-6.
constexpr double series_end = 0.15;

// The zeros of Ai and Ai' on the negative axis: Abramowitz and Stegun (1964), table 10.13, and beyond it their expansions 10.4.94
// and 10.4.95.
constexpr double first_soft_zeros[] = {2.33810741, 4.08794944, 5.52055983, 6.78670809, 7.94413359};
constexpr double first_hard_zeros[] = {1.01879297, 3.24819758, 4.82009921, 6.16330736, 7.37217726};

double soft_zero(int n) {
  if (n < 5) return first_soft_zeros[n];
  const double z = 3 * pi * (4 * n + 3) / 8;
  return std::cbrt(z * z) * (1 + 5 / (48 * z * z));
}

double hard_zero(int n) {
  if (n < 5) return first_hard_zeros[n];
  const double z = 3 * pi * (4 * n + 1) / 8;
  return std::cbrt(z * z) * (1 - 7 / (48 * z * z));
}

EdgeFactors by_series(double xi) {
  constexpr double eighth = std::numbers::sqrt2 / 2;  // cosine and sine of an eighth of a turn
  const double root = std::sqrt(pi), x = xi * std::sqrt(xi);
  const Complex turn = x * Complex(eighth, eighth), back = x * x * x * Complex(eighth, -eighth);
  return {1.0 - root / 4 * turn + Complex(0, 7.0 / 60) * x * x + 7 * root / 512 * back,
          1.0 - root / 2 * turn + Complex(0, 5.0 / 12) * x * x + 5 * root / 64 * back};
}

// The last residue left out is e^{-40 sin 60} = e^{-35}.
EdgeFactors by_residues(double xi) {
  const Complex turn = std::polar(1.0, -pi / 3);
  Complex hard = 0.0, soft = 0.0;
  for (int n = 0; xi * hard_zero(n) < 40.0; ++n) {
    const Complex h = hard_zero(n) * turn;
    hard += std::exp(Complex(0, -xi) * h) / h;
    soft += std::exp(Complex(0, -xi * soft_zero(n)) * turn);
  }
  const double root = std::sqrt(pi * xi);
  return {std::polar(root, -pi / 4) * hard, 2 * root * xi * std::polar(1.0, pi / 4) * soft};
}

// From one point before the end of the series to one beyond the last interval.
constexpr int first_entry = static_cast<int>(series_end * per_unit) - 1;

std::vector<EdgeFactors> tabulated() {
  std::vector<EdgeFactors> table;
  for (int i = first_entry; i <= table_end * per_unit + 1; ++i) table.push_back(by_residues(static_cast<double>(i) / per_unit));
  return table;
}

}  // namespace

// The cubic through four entries (Abramowitz and Stegun 25.2.13): smooth enough for factors at many frequencies to be found from
// a few.
EdgeFactors edge_factors(double xi) {
  if (xi < series_end) return by_series(xi);
  static const std::vector<EdgeFactors> table = tabulated();
  if (xi >= table_end) return {};
  const double x = xi * per_unit - first_entry;
  const auto i = static_cast<std::size_t>(x);
  const double p = x - static_cast<double>(i), q = 1.0 - p;
  const double weights[] = {-p * q * (q + 1.0) / 6.0, (1.0 + p) * q * (q + 1.0) / 2.0, p * (1.0 + p) * (q + 1.0) / 2.0,
                            -p * q * (1.0 + p) / 6.0};
  EdgeFactors result;
  for (std::size_t n = 0; n < 4; ++n) {
    result.hard += weights[n] * table[i + n - 1].hard;
    result.soft += weights[n] * table[i + n - 1].soft;
  }
  return result;
}

}  // namespace raytube
