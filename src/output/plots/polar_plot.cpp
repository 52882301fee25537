#include "output/plots/polar_plot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/decimal.h"
#include "output/plots/cut_panel.h"
#include "output/plots/gnuplot.h"

namespace raytube {

namespace {

// From the top down to what a tenth of the co-polar rows stay below, and a ring more: nulls would push all else to the rim.
Scale polar_scale(const Cut& cut) {
  Scale scale = scale_of({&cut, 1});
  std::vector<double> levels = cut.sigma_dbsm[0];
  levels.insert(levels.end(), cut.sigma_dbsm[3].begin(), cut.sigma_dbsm[3].end());
  const auto tenth = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 10);
  std::ranges::nth_element(levels, tenth);
  const double inner = std::max(scale.floor, *tenth);
  scale.top = 10.0 * std::ceil(scale.top / 10.0);
  scale.bottom = std::min(10.0 * std::floor(inner / 10.0) - 10.0, scale.top - 20.0);
  scale.floor = scale.bottom;
  return scale;
}

// Radii are decibels over the bottom: gnuplot paints over the middle of a disc that begins elsewhere than at 0.
std::string on_disc(double degrees, double level, const Scale& scale) {
  return fmt::format("{} {:.4f}\n", number_text(degrees), std::max(level - scale.bottom, 0.0));
}

// Over azimuths that end a step before they began the line closes: once more the first point.
std::vector<std::string> closed_curve(const std::vector<double>& degrees, const std::vector<double>& levels, const Scale& scale) {
  std::vector<std::string> points;
  for (std::size_t i = 0; i < degrees.size(); ++i) points.push_back(on_disc(degrees[i], levels[i], scale));
  const double step = (degrees.back() - degrees.front()) / static_cast<double>(degrees.size() - 1);
  if (degrees.front() + 360.0 - degrees.back() < 1.5 * step) points.push_back(points.front());
  return points;
}

std::vector<double> each(const std::vector<SectorLevels>& sectors, double SectorLevels::*level) {
  std::vector<double> values;
  for (const SectorLevels& sector : sectors) values.push_back(sector.*level);
  return values;
}

// There along the upper levels, and back along the lower ones.
std::vector<std::string> ring(const std::vector<double>& degrees, const std::vector<SectorLevels>& sectors, const Scale& scale) {
  std::vector<std::string> points = closed_curve(degrees, each(sectors, &SectorLevels::high), scale);
  const std::vector<std::string> back = closed_curve(degrees, each(sectors, &SectorLevels::low), scale);
  points.insert(points.end(), back.rbegin(), back.rend());
  return points;
}

std::string block(const char* name, int channel, const std::vector<std::string>& points) {
  return fmt::format("${}{} << EOD\n{}EOD\n", name, channel, fmt::join(points, ""));
}

std::string polar_data(const DrawnCut& drawn, const Scale& scale) {
  std::string text;
  for (const int channel : {0, 1, 2, 3}) {
    text += block("curve", channel, closed_curve(drawn.cut.x, drawn.cut.sigma_dbsm[channel], scale));
    if (!drawn.sectors) continue;
    const auto& [width, x, levels] = *drawn.sectors;
    text += block("median", channel, closed_curve(x, each(levels[channel], &SectorLevels::median), scale));
    text += block("ring", channel, ring(x, levels[channel], scale));
  }
  return text;
}

std::string polar_curve(int channel, const DrawnCut& drawn) {
  const char* title = channel_titles[channel];
  if (!drawn.sectors)
    return fmt::format(", \\\n     $curve{} with {} ls {} lw 1.5 title '{}'", channel, drawn.joined ? "lines" : "points",
                       channel + 1, title);
  std::string text = fmt::format(", \\\n     $curve{} with points ls {} pt 7 ps 0.25 notitle", channel, channel + 1);
  if (channel == 0 || channel == 3)
    text += fmt::format(", \\\n     $ring{} with filledcurves ls {} fs transparent solid 0.2 noborder title '{} 10–90 %'",
                        channel, channel + 1, title);
  return text + fmt::format(", \\\n     $median{} with lines ls {} title '{} median'", channel, channel + 1, title);
}

// On white, over the curves.
std::string ring_labels(const Scale& scale) {
  std::string text = "set style textbox opaque margins 0.3,0.3 fillcolor rgb 'white' noborder\n";
  for (double level = scale.bottom + 10.0; level <= scale.top; level += 10.0)
    text += fmt::format("set label '{}' at {},0 center offset 0,-1 front boxed\n", level, level - scale.bottom);
  return text;
}

std::string polar_axes(const Scale& scale) {
  return fmt::format(
      "set polar\nset angles degrees\nset size square\nset rrange [0:{}]\nset grid polar 30 lt 1 lw 1 lc rgb '#d9d9d9'\n"
      "unset border\nunset xtics\nunset ytics\nset ttics 0,30 format '%g°' scale 0\nset rtics 10 format '' scale 0.5\n{}",
      scale.top - scale.bottom, ring_labels(scale));
}

std::string polar_heading(const std::string& title, const DrawnCut& drawn) {
  std::string text = title + '\n' + drawn.cut.fixed + "; σ (dBsm) over " + axis_label(drawn.cut.quantity);
  if (!drawn.joined) text += "\nsteps too wide for the lobes";
  return text;
}

}  // namespace

bool has_full_circle(const Sweep& sweep) {
  const RowCoordinates coordinates = coordinates_of_rows({{sweep.frequencies.front()}, sweep.looks, sweep.bistatic});
  for (const auto quantity : {RowCoordinates::phi, RowCoordinates::rx_phi}) {
    for (const auto& group : rows_along(quantity, coordinates)) {
      std::vector<double> degrees;
      for (const std::size_t row : group) degrees.push_back(coordinates.rows[row][quantity]);
      if (goes_round(degrees)) return true;
    }
  }
  return false;
}

std::optional<std::string> polar_plot_script(const std::string& terminal, const std::string& file, const std::string& title,
                                             const Sweep& sweep, const SweepResult& result, std::span<const dvec3> outermost) {
  const RowCoordinates coordinates = coordinates_of_rows(sweep);
  for (const auto quantity : {RowCoordinates::phi, RowCoordinates::rx_phi}) {
    Cut cut = cut_through(peak_row(result), quantity, coordinates, result);
    if (!goes_round(cut.x)) continue;
    const DrawnCut drawn = drawn_cut(std::move(cut), sweep, outermost);
    const Scale scale = polar_scale(drawn.cut);
    std::string script = gnuplot_preamble(terminal, "1000,860", file) + channel_styles + polar_data(drawn, scale);
    script += "set title " + gnuplot_quoted_lines(polar_heading(title, drawn)) + '\n' + polar_axes(scale);
    if (drawn.sectors) script += fmt::format("set key title 'sectors of {}'\n", width_text(drawn));
    script += "plot NaN notitle";
    for (const int channel : {0, 1, 2, 3})
      script += is_shown(drawn.cut, channel, scale) ? polar_curve(channel, drawn) : channel_below(channel, true, scale);
    if (drawn.sectors) script += each_row_entry;
    return script + "\nset output\n";
  }
  return {};
}

}  // namespace raytube
