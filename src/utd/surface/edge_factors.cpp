#include "utd/surface/edge_factors.h"

#include <vector>

namespace raytube {

namespace {

constexpr int residues = 40, per_unit = 128, table_end = 12;
constexpr double series_end = 0.5;  // of xi

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
  const double root = std::sqrt(pi), x = xi * std::sqrt(xi);
  const Complex turn = std::polar(x, pi / 4), back = std::polar(x * x * x, -pi / 4);
  return {1.0 - root / 4 * turn + Complex(0, 7.0 / 60) * x * x + 7 * root / 512 * back,
          1.0 - root / 2 * turn + Complex(0, 5.0 / 12) * x * x + 5 * root / 64 * back};
}

EdgeFactors by_residues(double xi) {
  const Complex turn = std::polar(1.0, -pi / 3);
  Complex hard = 0.0, soft = 0.0;
  for (int n = 0; n < residues; ++n) {
    const Complex h = hard_zero(n) * turn;
    hard += std::exp(Complex(0, -xi) * h) / h;
    soft += std::exp(Complex(0, -xi * soft_zero(n)) * turn);
  }
  const double root = std::sqrt(pi * xi);
  return {std::polar(root, -pi / 4) * hard, std::polar(2 * root * xi, pi / 4) * soft};
}

std::vector<EdgeFactors> tabulated() {
  std::vector<EdgeFactors> table;
  for (int i = 0; i <= table_end * per_unit + 1; ++i) {
    const double xi = static_cast<double>(i) / per_unit;
    table.push_back(xi < series_end ? by_series(xi) : by_residues(xi));
  }
  return table;
}

}  // namespace

EdgeFactors edge_factors(double xi) {
  static const std::vector<EdgeFactors> table = tabulated();
  if (xi >= table_end) return {};
  const double x = xi * per_unit;
  const auto i = static_cast<std::size_t>(x);
  const double part = x - static_cast<double>(i);
  return {table[i].hard + part * (table[i + 1].hard - table[i].hard), table[i].soft + part * (table[i + 1].soft - table[i].soft)};
}

}  // namespace raytube
