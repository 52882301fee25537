#include "output/image_compare/structural_similarity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace raytube {

namespace {

constexpr int reach = 5;  // of the window: 11 pixels
constexpr double width = 1.5;

using Values = std::vector<double>;

std::array<double, reach + 1> gaussian() {
  std::array<double, reach + 1> weights{};
  for (int i = 0; i <= reach; ++i) weights[static_cast<std::size_t>(i)] = std::exp(-0.5 * i * i / (width * width));
  return weights;
}

// Weighted means along lines of `count` values `stride` apart that begin at `first`.
void smooth_line(const Values& in, Values& out, std::size_t first, std::size_t count, std::size_t stride) {
  static const std::array<double, reach + 1> weights = gaussian();
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0.0, whole = 0.0;
    for (std::size_t j = i - std::min<std::size_t>(i, reach); j <= std::min(i + reach, count - 1); ++j) {
      const double weight = weights[j > i ? j - i : i - j];
      sum += weight * in[first + j * stride], whole += weight;
    }
    out[first + i * stride] = sum / whole;
  }
}

Values smoothed(const Values& values, std::size_t columns) {
  const std::size_t rows = values.size() / columns;
  Values along(values.size()), both(values.size());
  for (std::size_t row = 0; row < rows; ++row) smooth_line(values, along, row * columns, columns, 1);
  for (std::size_t column = 0; column < columns; ++column) smooth_line(along, both, column, rows, columns);
  return both;
}

Values products(std::span<const double> a, std::span<const double> b) {
  Values product(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) product[i] = a[i] * b[i];
  return product;
}

}  // namespace

double structural_similarity(std::span<const double> a, std::span<const double> b, std::size_t columns, double range) {
  const double c1 = std::pow(0.01 * range, 2.0), c2 = std::pow(0.03 * range, 2.0);
  const Values mean_a = smoothed(Values(a.begin(), a.end()), columns), mean_b = smoothed(Values(b.begin(), b.end()), columns),
               aa = smoothed(products(a, a), columns), bb = smoothed(products(b, b), columns),
               ab = smoothed(products(a, b), columns);
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] <= 0.0 && b[i] <= 0.0) continue;
    const double product = mean_a[i] * mean_b[i], squares = mean_a[i] * mean_a[i] + mean_b[i] * mean_b[i];
    const double covariance = ab[i] - product, variances = aa[i] + bb[i] - squares;
    sum += (2.0 * product + c1) * (2.0 * covariance + c2) / ((squares + c1) * (variances + c2));
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 1.0;
}

}  // namespace raytube
