#include "output/plots/convergence_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/decimal.h"
#include "output/plots/gnuplot.h"

namespace raytube {

namespace {

constexpr double least_error = 1e-17, least_time = 1e-6;  // a logarithmic axis has no zero

constexpr const char* styles =
    "set style line 1 lc rgb '#1f5fbf' lw 2 pt 7 ps 1\nset style line 2 lc rgb '#888888' lw 1.5 dt (8,6)\n"
    "set style line 3 lc rgb '#d9480f' lw 2 pt 6 ps 2\nset style line 4 lc rgb '#2e8b3d' lw 1.5 dt (3,4)\n"
    "set key inside right top opaque\nset logscale xy\nset format y '%g'\nset ylabel 'estimated relative error of S'\n";

// Results made earlier say no times.
bool is_timed(const ConvergenceStudy& study) { return !std::isnan(study.results.front().solve_s); }

// Times, or else rays.
std::vector<double> costs(const ConvergenceStudy& study) {
  std::vector<double> values;
  for (const DensityResult& result : study.results)
    values.push_back(is_timed(study) ? std::max(result.solve_s, least_time)
                                     : static_cast<double>(std::max<std::uint64_t>(result.rays, 1)));
  return values;
}

std::vector<double> errors(const ConvergenceStudy& study) {
  std::vector<double> values;
  for (const DensityErrors& density : study.convergence.densities)
    values.push_back(std::max(density.relative_error, least_error));
  return values;
}

// density, cost, error
std::string data_block(const ConvergenceStudy& study) {
  const std::vector<double> cost = costs(study), error = errors(study);
  std::string text = "$study << EOD\n";
  for (std::size_t i = 0; i < study.results.size(); ++i)
    text += fmt::format("{} {:.6g} {:.6g}\n", number_text(study.results[i].per_wavelength), cost[i], error[i]);
  return text + "EOD\n";
}

// A straight line of the mean order through the finest density.
std::string order_line(const ConvergenceStudy& study) {
  const double order = study.convergence.extrapolation->mean_order;
  if (std::isnan(order)) return "";
  return fmt::format(", \\\n     {:.6g} * (x / {})**(-{:.6g}) with lines ls 2 title 'order {:.2f}, the mean'",
                     errors(study).back(), number_text(study.results.back().per_wavelength), order, order);
}

// Whole decades round all values.
std::string decades(const char* axis, const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax(values);
  const double bottom = std::floor(std::log10(low)), top = std::ceil(std::log10(high));
  return fmt::format("set {}range [1e{}:1e{}]\n", axis, bottom, top > bottom ? top : bottom + 1.0);
}

std::string points(int column, std::size_t count) {
  return fmt::format(
      "$study using {0}:3 with linespoints ls 1 title 'error', \\\n     $study every ::{1}::{1} using {0}:3 with points ls 3 "
      "title "
      "'finest: estimated by the order'",
      column, count - 1);
}

// The words stand where there is room: behind the line for the coarsest density, before it for all others.
std::string recommended_line(const ConvergenceStudy& study) {
  const auto& recommended = study.convergence.recommended;
  if (!recommended) return "";
  return fmt::format(
      "set arrow 1 from {0}, graph 0 to {0}, graph 1 nohead ls 4\nset label 1 'recommended: {0}' at {0}, graph 0.04 {1}\n",
      number_text(study.results[*recommended].per_wavelength), *recommended == 0 ? "left offset 0.7,0" : "right offset -0.7,0");
}

}  // namespace

std::string convergence_plot_script(const std::string& terminal, const std::string& file, const ConvergenceStudy& study) {
  const std::vector<DensityResult>& results = study.results;
  std::string script = gnuplot_preamble(terminal, "1400,640", file) + data_block(study) + styles + decades("y", errors(study));
  script += fmt::format("set multiplot layout 1,2 title {}\n", gnuplot_quoted(study.title)) + recommended_line(study);
  script += fmt::format("set xlabel 'tubes per wavelength'\nset xrange [{:.6g}:{:.6g}]\nset xtics (",
                        results.front().per_wavelength / 1.4, results.back().per_wavelength * 1.4);
  for (const DensityResult& result : results)
    script += fmt::format("{0}'{1}' {1}", &result == &results.front() ? "" : ", ", number_text(result.per_wavelength));
  script += ")\nplot " + points(1, results.size()) + order_line(study) + '\n';
  script += fmt::format("unset arrow 1\nunset label 1\nset xlabel '{}'\nset xtics auto\nset format x '%g'\n",
                        is_timed(study) ? "time (s)" : "rays");
  script += decades("x", costs(study)) + "plot " + points(2, results.size());
  return script + ", \\\n     $study using 2:3:1 with labels offset 1.5,0.7 notitle\nunset multiplot\nset output\n";
}

std::string plot_convergence(const std::filesystem::path& folder, const ConvergenceStudy& study) {
  if (!study.convergence.extrapolation) return "no plot: three densities are needed for the errors it shows";
  const std::string trouble = draw_pictures(folder, "converge", [&](const std::string& terminal, const std::string& file) {
    return convergence_plot_script(terminal, file, study);
  });
  return trouble.empty() ? "" : fmt::format("no plot: {}; converge.csv holds the numbers", trouble);
}

}  // namespace raytube
