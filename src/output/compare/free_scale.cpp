#include "output/compare/free_scale.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"

namespace raytube {

namespace {

double magnitude(const ResultTable::Row& row, int channel) {
  return std::pow(10.0, row.sigma_dbsm[channel] / 20.0) / std::sqrt(4.0 * pi);
}

}  // namespace

FreeScale fit_scale(const ResultTable& result, const ResultTable& reference, const RowMatch& match) {
  const auto common = [&](int c) { return result.has_channel[c] && reference.has_channel[c]; };
  bool phase = true;
  for (const int c : {0, 1, 2, 3})
    if (common(c)) phase = phase && result.has_phase[c] && reference.has_phase[c];
  Complex product = 0.0;
  double square = 0.0;
  for (const auto& [i, j] : match.common)
    for (const int c : {0, 1, 2, 3}) {
      if (!common(c)) continue;
      const ResultTable::Row &a = result.rows[i], &b = reference.rows[j];
      product += phase ? std::conj(a.s[c]) * b.s[c] : magnitude(a, c) * magnitude(b, c);
      square += std::pow(magnitude(a, c), 2);
    }
  const Complex factor = product / square;
  if (!(std::abs(factor) > 0.0) || !std::isfinite(std::abs(factor)))
    throw InputError(fmt::format("--free-scale: {} and {} have no signal in common; leave the option out", result.file.string(),
                                 reference.file.string()));
  return {factor, phase};
}

void apply_scale(ResultTable& table, Complex factor) {
  for (ResultTable::Row& row : table.rows)
    for (const int c : {0, 1, 2, 3}) {
      row.s[c] *= factor;
      row.sigma_dbsm[c] += 20.0 * std::log10(std::abs(factor));
    }
}

}  // namespace raytube
