#include "output/compare/convergence_report.h"

#include <fmt/format.h>

#include <cmath>

#include "core/decimal.h"
#include "output/files/files.h"
#include "output/tables/csv.h"
#include "output/tables/cuts.h"

namespace raytube {

namespace {

std::string three_digits(double value) { return std::isnan(value) ? "-" : fmt::format("{:.3g}", value); }

std::string seconds_text(double value) { return std::isnan(value) ? "-" : fmt::format("{:.3f}", value); }

Complex strongest(const ConvergenceStudy& study, const std::vector<ScatteringMatrix>& total) {
  const int c = study.convergence.strongest_channel;
  return total[study.convergence.strongest_row].at(c / 2, c % 2);
}

const char* strongest_channel(const ConvergenceStudy& study) { return channel_names[study.convergence.strongest_channel]; }

std::string strongest_row_text(const ConvergenceStudy& study) {
  return coordinates_text(coordinates_of_rows(study.sweep), study.convergence.strongest_row);
}

constexpr const char* table_line = "{:>6}{:>12}{:>12}{:>9}{:>11}{:>11}{:>11}{:>10}{:>7}{:>12}{:>11}\n";

std::string density_line(const ConvergenceStudy& study, std::size_t i) {
  const DensityResult& result = study.results[i];
  const DensityErrors& errors = study.convergence.densities[i];
  return fmt::format(table_line, number_text(result.per_wavelength), result.tubes, result.rays, seconds_text(result.solve_s),
                     fmt::format("{:.4f}", sigma_dbsm(strongest(study, result.total))), fmt::format("{:.5g}", errors.norm),
                     three_digits(errors.change), three_digits(errors.relative_change), three_digits(errors.order),
                     three_digits(errors.relative_error), three_digits(errors.rms_db));
}

std::string order_text(const ConvergenceStudy& study) {
  const Extrapolation& e = *study.convergence.extrapolation;
  if (std::isnan(e.order)) return "none: the finest densities agree to rounding\n";
  const std::size_t n = study.results.size();
  const auto density = [&](std::size_t i) { return number_text(study.results[i].per_wavelength); };
  return fmt::format("{:.2f}, from {}, {} and {} tubes per wavelength; {:.2f} on average over all\n", e.order, density(n - 3),
                     density(n - 2), density(n - 1), e.mean_order);
}

std::string extrapolated_text(const ConvergenceStudy& study) {
  const Extrapolation& e = *study.convergence.extrapolation;
  const Complex s = strongest(study, e.total);
  if (s == 0.0) return "zero: no return in any row\n";
  const double uncertainty_db = 20.0 * std::log10(1.0 + e.strongest_uncertainty / std::abs(s));
  return fmt::format("S_{} = {:.8g} {} {:.8g}j m +- {:.2g} m, {:.6f} dBsm +- {:.2g} dB at {}\n", strongest_channel(study),
                     s.real(), s.imag() < 0.0 ? '-' : '+', std::abs(s.imag()), e.strongest_uncertainty, sigma_dbsm(s),
                     uncertainty_db, strongest_row_text(study));
}

std::string recommendation_text(const ConvergenceStudy& study) {
  const Convergence& c = study.convergence;
  if (!c.recommended)
    return fmt::format("none of these reaches {:g} dB rms; by the order, about {:.3g} tubes per wavelength would\n",
                       fine_enough_db, c.extrapolation->next_density);
  return fmt::format("tubes.per_wavelength = {}, the coarsest below {:g} dB rms within 20 dB of the peak (estimated {} dB)\n",
                     number_text(study.results[*c.recommended].per_wavelength), fine_enough_db,
                     three_digits(c.densities[*c.recommended].rms_db));
}

std::string conclusions(const ConvergenceStudy& study, const std::string& margin) {
  if (!study.convergence.extrapolation) return margin + "order and estimates need three densities\n";
  return margin + "order           " + order_text(study) + margin + "extrapolated    " + extrapolated_text(study) + margin +
         fmt::format("uncertainty     {} of ||S||, over all rows and channels\n",
                     three_digits(study.convergence.extrapolation->relative_uncertainty)) +
         margin + "recommendation  " + recommendation_text(study);
}

std::string csv_row(const ConvergenceStudy& study, std::size_t i) {
  const DensityResult& result = study.results[i];
  const DensityErrors& errors = study.convergence.densities[i];
  const Complex s = strongest(study, result.total);
  std::string row = fmt::format("{},{},{}", number_text(result.per_wavelength), result.tubes, result.rays);
  for (const double value : {result.solve_s, s.real(), s.imag(), sigma_dbsm(s), errors.norm, errors.change,
                             errors.relative_change, errors.order, errors.relative_error, errors.rms_db})
    row += ',' + number_text(value);
  return row + '\n';
}

}  // namespace

std::string convergence_text(const ConvergenceStudy& study) {
  std::string text =
      fmt::format(table_line, "tubes", "", "", "", "strongest", "", "change to", "relative", "", "estimated", "estimated");
  text += fmt::format(table_line, "per λ", "tubes", "rays", "time, s", "row, dBsm", "||S||, m", "next, m", "change", "order",
                      "rel. error", "rms, dB");
  for (std::size_t i = 0; i < study.results.size(); ++i) text += density_line(study, i);
  return text + '\n' + conclusions(study, "");
}

void write_converge_csv(const std::filesystem::path& file, const ConvergenceStudy& study) {
  OutputFile out(file);
  out.write(fmt::format("# strongest row: {}, {}; re_m, im_m and sigma_dbsm are its\n", strongest_channel(study),
                        strongest_row_text(study)));
  out.write(
      "# norm: sqrt(sum |S|^2) over all rows and channels; estimated_rms_db: the worst channel's, within 20 dB of its peak\n");
  out.write(conclusions(study, "# "));
  out.write(
      "per_wavelength,tubes,rays,solve_s,re_m,im_m,sigma_dbsm,norm_m,change_to_next_m,relative_change_to_next,observed_order,"
      "estimated_relative_error,estimated_rms_db\n");
  for (std::size_t i = 0; i < study.results.size(); ++i) out.write(csv_row(study, i));
  out.commit();
}

}  // namespace raytube
