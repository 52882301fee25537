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

void ScaleFit::add(Complex result, Complex reference) {
  product_ += std::conj(result) * reference;
  of_magnitudes_ += std::abs(result) * std::abs(reference);
  square_ += std::norm(result);
}

FreeScale ScaleFit::scale(const std::filesystem::path& result, const std::filesystem::path& reference) const {
  const Complex factor = (phase_ ? product_ : Complex(of_magnitudes_)) / square_;
  if (!(std::abs(factor) > 0.0) || !std::isfinite(std::abs(factor)))
    throw InputError(fmt::format("--free-scale: {} and {} have no signal in common; leave the option out", result.string(),
                                 reference.string()));
  return {factor, phase_};
}

FreeScale fit_scale(const ResultTable& result, const ResultTable& reference, const RowMatch& match) {
  ScaleFit fit;
  for (const int c : {0, 1, 2, 3}) {
    if (!result.has_channel[c] || !reference.has_channel[c]) continue;
    if (!result.has_phase[c] || !reference.has_phase[c]) fit.leave_phase();
    for (const auto& [i, j] : match.common)
      fit.add(amplitude(result, result.rows[i], c), amplitude(reference, reference.rows[j], c));
  }
  return fit.scale(result.file, reference.file);
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
