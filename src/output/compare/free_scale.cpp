#include "output/compare/free_scale.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"

namespace raytube {

namespace {

// With the magnitude that a level stands for where there is no phase.
Complex amplitude(const ResultTable& table, const ResultTable::Row& row, int channel) {
  return table.has_phase[channel] ? row.s[channel] : std::pow(10.0, row.sigma_dbsm[channel] / 20.0) / std::sqrt(4.0 * pi);
}

}  // namespace

FreeScale fit_scale(const ResultTable& result, const ResultTable& reference, const RowMatch& match) {
  bool phase = true;
  Complex product = 0.0;
  double of_magnitudes = 0.0, square = 0.0;
  for (const int c : {0, 1, 2, 3}) {
    if (!result.has_channel[c] || !reference.has_channel[c]) continue;
    phase = phase && result.has_phase[c] && reference.has_phase[c];
    for (const auto& [i, j] : match.common) {
      const Complex a = amplitude(result, result.rows[i], c), b = amplitude(reference, reference.rows[j], c);
      product += std::conj(a) * b;
      of_magnitudes += std::abs(a) * std::abs(b);
      square += std::norm(a);
    }
  }
  const Complex factor = (phase ? product : Complex(of_magnitudes)) / square;
  if (!(std::abs(factor) > 0.0) || !std::isfinite(std::abs(factor)))
    throw InputError(fmt::format("--free-scale: {} and {} have no signal in common; leave the option out", result.file.string(),
                                 reference.file.string()));
  return {factor, phase};
}

std::string scale_text(const FreeScale& scale) {
  const double db = 20.0 * std::log10(std::abs(scale.factor)), turn = std::arg(scale.factor) / degree;
  const std::string phase = scale.phase ? fmt::format(", {:+.4g} degrees", turn) : "";
  return fmt::format("{:<12}the result by {:+.4g} dB{}, fitted (--free-scale)\n", "scaled", db, phase);
}

void apply_scale(ResultTable& table, Complex factor) {
  for (ResultTable::Row& row : table.rows)
    for (const int c : {0, 1, 2, 3}) {
      row.s[c] *= factor;
      row.sigma_dbsm[c] += 20.0 * std::log10(std::abs(factor));
    }
}

}  // namespace raytube
