#include "output/charts/polar_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/decimal.h"
#include "core/error.h"
#include "output/charts/chart_style.h"
#include "output/charts/curve_chart.h"
#include "output/charts/ordinate.h"
#include "output/plots/gnuplot.h"
#include "output/tables/sliding_sector.h"

namespace raytube {

namespace {

constexpr double ring_db = 10.0, most_polar_range_db = 80.0;

bool over_azimuth(const ChartResult& result) {
  return result.plan.quantity == RowCoordinates::phi || result.plan.quantity == RowCoordinates::rx_phi;
}

void require_angle(const ChartResult& result) {
  if (result.plan.quantity == RowCoordinates::frequency || result.plan.quantity == RowCoordinates::look_number)
    throw InputError(fmt::format("--kind polar: {} is a sweep over {}, not over an angle; use --kind curves",
                                 result.file.string(), result.plan.axis));
}

std::vector<double> levels_of_panel(const CutPanel& panel, const std::vector<ChartResult>& results,
                                    const std::vector<std::size_t>& channels) {
  std::vector<double> levels;
  for (const ChartCut& cut : panel.cuts)
    for (const std::size_t c : channels)
      for (const std::size_t row : cut.rows.rows) levels.push_back(results[cut.result].sigma_dbsm[c][row]);
  return levels;
}

// Whole rings, down to what a tenth of the rows stay below, and a ring more: nulls would push all else to the rim.
Ordinate polar_ordinate(std::vector<double> levels, const ChartOptions& options) {
  const auto tenth = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 10);
  std::ranges::nth_element(levels, tenth);
  const double low = *tenth, peak = std::ranges::max(levels);
  Ordinate axis = ordinate(options, peak, std::max(low, peak - most_polar_range_db), most_polar_range_db);
  if (!axis.decibels()) return axis;
  axis.top = ring_db * std::ceil((axis.unit == ChartUnit::dbsm ? axis.peak_dbsm : 0.0) / ring_db);
  axis.bottom = options.range_db ? axis.top - ring_db * std::ceil(*options.range_db / ring_db)
                                 : std::min(ring_db * std::floor(axis.bottom / ring_db) - ring_db, axis.top - 2.0 * ring_db);
  return axis;
}

// Radii begin at the bottom: gnuplot paints over the middle of a disc that begins elsewhere than at 0.
std::string disc_point(double degrees, double sigma_dbsm, const Ordinate& axis) {
  return fmt::format("{} {:.6g}\n", number_text(degrees), std::max(axis.of(sigma_dbsm) - axis.bottom, 0.0));
}

// Over azimuths that end a step before they began the line closes: once more the first point.
bool wants_closing(const std::vector<double>& x) {
  if (!goes_round(x)) return false;
  const double step = (x.back() - x.front()) / static_cast<double>(x.size() - 1);
  return x.front() + 360.0 - x.back() > 1e-6 && x.front() + 360.0 - x.back() < 1.5 * step;
}

std::string disc_block(std::size_t number, const CutRows& cut, const std::vector<double>& sigma_dbsm, const Ordinate& axis,
                       bool round) {
  std::string text = fmt::format("$disc{} << EOD\n", number);
  for (std::size_t i = 0; i < cut.x.size(); ++i) text += disc_point(cut.x[i], sigma_dbsm[cut.rows[i]], axis);
  if (round && wants_closing(cut.x)) text += disc_point(cut.x.front(), sigma_dbsm[cut.rows.front()], axis);
  return text + "EOD\n";
}

// On white, over the curves.
std::string labels_of_rings(const Ordinate& axis, bool azimuth) {
  std::string text = "set style textbox opaque margins 0.3,0.3 fillcolor rgb 'white' noborder\n";
  const double end = axis.top + 0.01 * axis.step;
  for (double level = axis.bottom + axis.step; level <= end; level += axis.step) {
    const std::string radius = fmt::format("{:.6g}", level - axis.bottom);
    text += fmt::format("set label '{:.4g}' at {} center front boxed\n", level,
                        azimuth ? fmt::format("{},0 offset 0,-1", radius) : fmt::format("0,{} offset 2,0", radius));
  }
  return text;
}

std::string disc_axes(const Ordinate& axis, bool azimuth) {
  return fmt::format(
      "set polar\nset angles degrees\n{}set size square\nset rrange [0:{:.6g}]\nset grid polar 30 lt 1 lw 1 lc rgb '#d9d9d9'\n"
      "unset border\nunset xtics\nunset ytics\nset ttics 0,30 format '%g°' scale 0\nset rtics {:.6g} format '' scale 0.5\n{}",
      azimuth ? "" : "set theta top clockwise\n", axis.top - axis.bottom, axis.step, labels_of_rings(axis, azimuth));
}

std::string disc_heading(const std::string& title, const CutPanel& panel, const Ordinate& axis, const ChartResult& result) {
  return fmt::format("{}\n{}{}{} over {}", title, panel.title, panel.title.empty() ? "" : "; ", axis.label(), result.plan.axis);
}

}  // namespace

Chart polar_chart(const std::vector<ChartResult>& results, const std::vector<std::size_t>& channels,
                  const ChartOptions& options) {
  require_angle(results.front());
  const CutPanel panel = cut_panels(results, 1).front();
  const Ordinate axis = polar_ordinate(levels_of_panel(panel, results, channels), options);
  const bool azimuth = over_azimuth(results.front());
  Chart chart{laid_out({1000.0, 860.0}, options), options.size, {}};
  std::string curves = "plot NaN notitle";
  std::size_t number = 0;
  for (const ChartCut& cut : panel.cuts)
    for (const std::size_t c : channels) {
      chart.commands += disc_block(number, cut.rows, results[cut.result].sigma_dbsm[c], axis, azimuth);
      curves += fmt::format(", \\\n     $disc{} {} title {}", number++,
                            curve_look({cut.result, results.size(), c, cut.rows.x.size(), options.print}),
                            gnuplot_quoted(curve_title(panel, cut, c, results)));
    }
  chart.commands += "set title " + gnuplot_quoted_lines(disc_heading(options.title, panel, axis, results.front())) + '\n';
  chart.commands += disc_axes(axis, azimuth) + curves + '\n';
  return chart;
}

}  // namespace raytube
