#include "output/compare/convergence.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "output/compare/error_measures.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

using Matrices = std::vector<ScatteringMatrix>;

constexpr double undefined = ErrorMeasures::undefined;
constexpr double convergence_range_db = 20.0;
constexpr double least_order = 0.5, greatest_order = 2.0;
constexpr double rounding = 1e-12;  // changes below this share of S say nothing about convergence

double product(const Matrices& a, const Matrices& b) {
  double sum = 0.0;
  for (std::size_t row = 0; row < a.size(); ++row)
    for (int c = 0; c < 4; ++c) sum += std::real(std::conj(a[row].at(c / 2, c % 2)) * b[row].at(c / 2, c % 2));
  return sum;
}

double norm_of(const Matrices& a) { return std::sqrt(product(a, a)); }

// a + factor * b
Matrices sum_of(Matrices a, double factor, const Matrices& b) {
  for (std::size_t row = 0; row < a.size(); ++row)
    for (int c = 0; c < 4; ++c) a[row].at(c / 2, c % 2) += factor * b[row].at(c / 2, c % 2);
  return a;
}

double share(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

// The p for which (n2^-p - n3^-p) / (n1^-p - n2^-p), which falls as p grows, is `ratio`; n1 < n2 < n3.
double order_from(double ratio, double n1, double n2, double n3) {
  const double a = std::log(n3 / n2), b = std::log(n2 / n1);
  double low = -20.0, high = 60.0;
  while (high - low > 1e-12) {
    const double p = 0.5 * (low + high), here = p == 0.0 ? a / b : -std::expm1(-p * a) / std::expm1(p * b);
    (here > ratio ? low : high) = p;
  }
  return low;
}

double cautious(double order) { return std::isnan(order) ? least_order : std::clamp(order, least_order, greatest_order); }

// Three densities in a row.
struct Triple {
  const DensityResult &coarse, &middle, &fine;
  Matrices first = sum_of(middle.total, -1.0, coarse.total), last = sum_of(fine.total, -1.0, middle.total);

  double order() const {
    const double size = rounding * norm_of(fine.total), before = norm_of(first), behind = norm_of(last);
    if (before <= size || behind <= size) return undefined;
    return order_from(behind / before, coarse.per_wavelength, middle.per_wavelength, fine.per_wavelength);
  }
};

// The errors behind a triple; notation and formulas as in the header.
struct ErrorModel {
  double A, B, rho;

  explicit ErrorModel(const Triple& triple) {
    const double p = cautious(triple.order());
    A = std::pow(triple.middle.per_wavelength / triple.coarse.per_wavelength, p);
    B = std::pow(triple.fine.per_wavelength / triple.middle.per_wavelength, p);
    const double q = share(product(triple.first, triple.last), product(triple.first, triple.first));
    const double above = 1.0 + q * (1.0 + A * A), below = 1.0 / B - A / B + A + 2.0 * q * A;
    rho = above > 0.0 ? std::min(above / below, 1.0) : 0.0;
  }

  double spread() const { return 1.0 + B * B - 2.0 * rho * B; }
  double finest() const { return 1.0 / std::sqrt(spread()); }  // of ||D2||
  double weight() const { return (rho * B - 1.0) / spread(); }
};

std::vector<double> levels(const Matrices& total, int channel) {
  std::vector<double> sigma;
  for (const ScatteringMatrix& s : total) sigma.push_back(sigma_dbsm(s.at(channel / 2, channel % 2)));
  return sigma;
}

// The worst channel's rms error in dB near its peak.
double rms_db(const Matrices& result, const Matrices& reference) {
  std::array<ChannelPair, 4> pairs;
  double highest = sigma_dbsm(0.0), worst = 0.0;
  for (int c = 0; c < 4; ++c) {
    pairs[c] = {levels(result, c), levels(reference, c), {}, {}};
    highest = std::max(highest, std::ranges::max(pairs[c].reference_dbsm));
  }
  for (const ChannelPair& pair : pairs) {
    const double peak = std::ranges::max(pair.reference_dbsm);
    if (peak > sigma_dbsm(0.0) && peak >= highest - dynamic_range_db)
      worst = std::max(worst, measure_errors(pair, convergence_range_db).rms_db);
  }
  return worst;
}

void find_strongest(const Matrices& finest, Convergence& study) {
  double strongest = -1.0;
  for (std::size_t row = 0; row < finest.size(); ++row)
    for (int c = 0; c < 4; ++c)
      if (const double size = std::abs(finest[row].at(c / 2, c % 2)); size > strongest)
        strongest = size, study.strongest_row = row, study.strongest_channel = c;
}

void measure_changes(std::span<const DensityResult> results, Convergence& study) {
  const double finest_norm = norm_of(results.back().total);
  for (std::size_t i = 0; i < results.size(); ++i) {
    DensityErrors& errors = study.densities.emplace_back(
        DensityErrors{norm_of(results[i].total), undefined, undefined, undefined, undefined, undefined});
    if (i + 1 < results.size()) {
      errors.change = norm_of(sum_of(results[i + 1].total, -1.0, results[i].total));
      errors.relative_change = share(errors.change, finest_norm);
    }
    if (i >= 2) errors.order = Triple{results[i - 2], results[i - 1], results[i]}.order();
  }
}

double mean_order(const Convergence& study) {
  double sum = 0.0;
  int count = 0;
  for (const DensityErrors& errors : study.densities)
    if (!std::isnan(errors.order)) sum += errors.order, ++count;
  return count ? sum / count : undefined;
}

Extrapolation extrapolate(const Triple& triple, const Convergence& study) {
  Extrapolation e{triple.order(), mean_order(study), {}, 0.0, 0.0, undefined};
  const ErrorModel model(triple);
  const int c = study.strongest_channel;
  e.total = sum_of(triple.fine.total, model.weight(), triple.last);
  e.relative_uncertainty = share(model.finest() * norm_of(triple.last), norm_of(triple.fine.total));
  e.strongest_uncertainty = model.finest() * std::abs(triple.last[study.strongest_row].at(c / 2, c % 2));
  return e;
}

// Against the extrapolated value; that it is no better than its uncertainty matters for the finest one.
void estimate_errors(std::span<const DensityResult> results, Convergence& study) {
  const Extrapolation& e = *study.extrapolation;
  const double size = norm_of(e.total);
  for (std::size_t i = 0; i < results.size(); ++i) {
    study.densities[i].relative_error = share(norm_of(sum_of(results[i].total, -1.0, e.total)), size);
    study.densities[i].rms_db = rms_db(results[i].total, e.total);
  }
  DensityErrors& finest = study.densities.back();
  const std::size_t before = results.size() - 2;
  const double expected = std::pow(results[before].per_wavelength / results.back().per_wavelength, cautious(e.order));
  finest.relative_error = std::max(finest.relative_error, e.relative_uncertainty);
  finest.rms_db = std::max(finest.rms_db, expected * study.densities[before].rms_db);
}

void recommend(std::span<const DensityResult> results, Convergence& study) {
  for (std::size_t i = results.size(); i-- > 0 && study.densities[i].rms_db < fine_enough_db;) study.recommended = i;
  if (!study.recommended)
    study.extrapolation->next_density = results.back().per_wavelength * std::pow(study.densities.back().rms_db / fine_enough_db,
                                                                                 1.0 / cautious(study.extrapolation->order));
}

}  // namespace

Convergence study_convergence(std::span<const DensityResult> results) {
  Convergence study;
  find_strongest(results.back().total, study);
  measure_changes(results, study);
  if (results.size() < 3) return study;
  const std::size_t n = results.size();
  study.extrapolation = extrapolate(Triple{results[n - 3], results[n - 2], results[n - 1]}, study);
  estimate_errors(results, study);
  recommend(results, study);
  return study;
}

}  // namespace raytube
