#include "output/picture/rcs_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/decimal.h"
#include "output/picture/gnuplot.h"
#include "output/tables/csv.h"
#include "output/tables/cuts.h"
#include "output/tables/sampled_rows.h"

namespace raytube {

namespace {

using Quantity = RowCoordinates::Quantity;

constexpr std::size_t most_panels = 4;  // curves of a second quantity with no more values than these stand in panels of their own
constexpr std::size_t most_dots = 600;  // of a map along an axis: about its pixels
constexpr double curve_range = 80.0;    // [dB] shown below the peak: what lies deeper is nulls and rounding
constexpr double map_range = 50.0;      // [dB]
constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

// Dashed over solid, so that two equal curves both show.
constexpr const char* styles =
    "set style line 1 lc rgb '#1f5fbf' lw 3 pt 7 ps 0.7\nset style line 2 lc rgb '#2e8b3d' lw 2 pt 5 ps 0.6\n"
    "set style line 3 lc rgb '#c040c0' lw 2 dt (16,16) pt 4 ps 1.1\nset style line 4 lc rgb '#d9480f' lw 2 dt (10,6) pt 6 ps "
    "1.1\n"
    "set grid lt 1 lw 1 lc rgb '#d9d9d9'\nset key outside right top vertical Left reverse samplen 3\n";
// viridis (Smith & van der Walt 2015): perceptually even, and readable in grey.
constexpr const char* palette =
    "set palette defined (0 '#440154', 1 '#472d7b', 2 '#3b528b', 3 '#2c728e', 4 '#21918c', 5 '#28ae80', 6 '#5ec962', 7 "
    "'#addc30', "
    "8 '#fde725')\n";

struct Picture {
  std::string size, commands;
};

// --- curves ---

std::string curve_panel(const Cut& cut, bool joined, double floor) {
  std::string text =
      fmt::format("set title {}\n$rows << EOD\n", gnuplot_quoted(cut.fixed + (joined ? "" : "; steps too wide for the lobes")));
  for (std::size_t i = 0; i < cut.x.size(); ++i)
    text += fmt::format("{} {:.4f} {:.4f} {:.4f} {:.4f}\n", number_text(cut.x[i]), std::max(cut.sigma_dbsm[0][i], floor),
                        std::max(cut.sigma_dbsm[1][i], floor), std::max(cut.sigma_dbsm[2][i], floor),
                        std::max(cut.sigma_dbsm[3][i], floor));
  const double margin = cut.x.front() < cut.x.back() ? 0.0 : 1.0;
  text += fmt::format("EOD\nset xrange [{}:{}]\nplot NaN notitle", cut.x.front() - margin, cut.x.back() + margin);
  const char* const style = cut.x.size() == 1 || !joined ? "points" : cut.x.size() <= 60 ? "linespoints" : "lines";
  for (std::size_t channel = 0; channel < 4; ++channel)
    if (std::ranges::max(cut.sigma_dbsm[channel]) > floor)
      text += fmt::format(", $rows using 1:{} with {} ls {} title '{}'", channel + 2, style, channel + 1,
                          std::array{"VV", "VH", "HV", "HH"}[channel]);
  return text + "\n";
}

Picture curves(const std::string& title, const Sweep& sweep, const SweepResult& result, std::span<const dvec3> outermost) {
  const Cuts cuts = choose_cuts(sweep, result, most_panels);
  double peak = -std::numeric_limits<double>::infinity(), lowest = std::numeric_limits<double>::infinity();
  for (const Cut& cut : cuts.cuts)
    for (const auto& channel : cut.sigma_dbsm) peak = std::max(peak, std::ranges::max(channel));
  if (!std::isfinite(peak)) peak = 0.0;  // nothing comes back at all
  for (const Cut& cut : cuts.cuts)
    for (const auto& channel : cut.sigma_dbsm)
      for (const double level : channel)
        if (level >= peak - curve_range) lowest = std::min(lowest, level);
  const double bottom = 10.0 * std::floor(std::min(lowest, peak - 1.0) / 10.0), top = 5.0 * std::ceil((peak + 2.0) / 5.0);
  const std::size_t panels = cuts.cuts.size();
  const std::string heading =
      panels == cuts.total ? title
                           : fmt::format("{} ({} of {} cuts, among them that through the peak)", title, panels, cuts.total);
  std::string text =
      fmt::format("{}set xlabel '{}'\nset ylabel 'σ (dBsm)'\nset yrange [{}:{}]\nset multiplot layout {} title {}\n", styles,
                  cuts.axis, bottom, top,
                  panels == 1   ? "1,1"
                  : panels == 2 ? "2,1"
                                : "2,2",
                  gnuplot_quoted(heading));
  // Levels below the bottom are drawn just beneath it, so that their line leaves the picture.
  for (const Cut& cut : cuts.cuts) text += curve_panel(cut, can_be_joined(sweep, outermost, cut.rows), bottom - 20.0);
  return {panels == 1 ? "1100,640" : panels == 2 ? "1100,1000" : "1700,1000", text + "unset multiplot\n"};
}

// --- maps ---

// Rows over two quantities with all others as at the peak.
struct Grid {
  Quantity across, up;
  std::vector<double> x, y;  // ascending
  std::vector<std::size_t> rows;
};

std::vector<double> distinct(Quantity quantity, const RowCoordinates& coordinates, const std::vector<std::size_t>& rows) {
  std::vector<double> values;
  for (const std::size_t row : rows) values.push_back(coordinates.rows[row][quantity]);
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

// None where fewer than half of its places would be filled, or where panels show the second quantity.
std::optional<Grid> grid_through_peak(const RowCoordinates& coordinates, Quantity across, std::size_t peak) {
  std::optional<Grid> best;
  for (const Quantity up : {RowCoordinates::phi, RowCoordinates::theta, RowCoordinates::rx_phi, RowCoordinates::rx_theta,
                            RowCoordinates::time, RowCoordinates::frequency}) {
    if (across == up || across == RowCoordinates::look_number) continue;
    Grid grid{across, up, {}, {}, {}};
    for (std::size_t row = 0; row < coordinates.rows.size(); ++row) {
      bool fits = true;
      for (std::size_t q = 0; q < RowCoordinates::look_number; ++q)
        fits = fits && (q == across || q == up || coordinates.rows[row][q] == coordinates.rows[peak][q]);
      if (fits) grid.rows.push_back(row);
    }
    grid.x = distinct(across, coordinates, grid.rows), grid.y = distinct(up, coordinates, grid.rows);
    const bool full = 2 * grid.rows.size() >= grid.x.size() * grid.y.size();
    if (full && grid.y.size() > most_panels && (!best || grid.y.size() > best->y.size())) best = std::move(grid);
  }
  return best;
}

// Even dots from the first value to the last: each holds the strongest of the values that are nearest to it, so that no peak is
// lost, and a dot to which none is nearest holds its nearest value's.
struct Dots {
  double first, step;
  std::size_t count;

  explicit Dots(const std::vector<double>& values) : first(values.front()), step(1.0), count(1) {
    double least = values.back() - values.front();
    for (std::size_t i = 1; i < values.size(); ++i) least = std::min(least, values[i] - values[i - 1]);
    if (least <= 0.0) return;
    count = std::min(most_dots, static_cast<std::size_t>(std::lround((values.back() - first) / least)) + 1);
    step = (values.back() - first) / static_cast<double>(count - 1);
  }
  std::size_t of(double value) const { return static_cast<std::size_t>(std::lround((value - first) / step)); }
  std::size_t from(double border) const { return static_cast<std::size_t>(std::ceil((border - first) / step - 1e-9)); }
  double low() const { return first - 0.5 * step; }
  double high() const { return low() + step * static_cast<double>(count); }
};

// The dots [first, last) that a value covers: its own, and others up to halfway to its neighbours.
std::pair<std::size_t, std::size_t> covered(const std::vector<double>& values, double value, const Dots& dots) {
  const auto at = std::ranges::lower_bound(values, value);
  const double low = at == values.begin() ? value : 0.5 * (value + *std::prev(at));
  const double high = std::next(at) == values.end() ? value : 0.5 * (value + *std::next(at));
  return {std::min(dots.from(low), dots.of(value)), std::max(dots.from(high), dots.of(value) + 1)};
}

std::string map_panel(const char* name, int channel, const Grid& grid, const RowCoordinates& coordinates,
                      const SweepResult& result) {
  const Dots x(grid.x), y(grid.y);
  std::vector<double> levels(x.count * y.count, not_there);
  for (const std::size_t row : grid.rows) {
    const double level = std::max(sigma_dbsm(result.total[row].at(channel, channel)), -400.0);
    const auto [left, right] = covered(grid.x, coordinates.rows[row][grid.across], x);
    const auto [below, above] = covered(grid.y, coordinates.rows[row][grid.up], y);
    for (std::size_t j = below; j < above; ++j)
      for (std::size_t i = left; i < right; ++i) levels[j * x.count + i] = std::fmax(levels[j * x.count + i], level);
  }
  std::string text = "$map << EOD\n";
  for (std::size_t i = 0; i < levels.size(); ++i)
    text += (std::isnan(levels[i]) ? "NaN" : fmt::format("{:.2f}", levels[i])) + ((i + 1) % x.count == 0 ? '\n' : ' ');
  return text + fmt::format(
                    "EOD\nset title '{}'\nset xrange [{}:{}]\nset yrange [{}:{}]\nplot $map using ({}+{}*$1):({}+{}*$2):3 matrix "
                    "with image notitle\n",
                    name, x.low(), x.high(), y.low(), y.high(), x.first, x.step, y.first, y.step);
}

Picture maps(const std::string& title, const Grid& grid, const RowCoordinates& coordinates, const SweepResult& result,
             std::size_t peak) {
  const double top = std::ceil(sigma_dbsm(largest_amplitude(result.total[peak])));
  std::string text = fmt::format(
      "{}unset key\nset tics out nomirror\nset cbrange [{}:{}]\nset cblabel 'σ (dBsm)'\nset xlabel '{}'\nset ylabel '{}'\n"
      "set multiplot layout 1,2 title {}\n",
      palette, std::isfinite(top) ? top - map_range : -map_range, std::isfinite(top) ? top : 0.0, axis_label(grid.across),
      axis_label(grid.up), gnuplot_quoted(fmt::format("{}\npeak at {}", title, coordinates_text(coordinates, peak))));
  text += map_panel("VV", 0, grid, coordinates, result) + map_panel("HH", 1, grid, coordinates, result);
  return {"1500,680", text + "unset multiplot\n"};
}

}  // namespace

std::string draw_rcs(const std::filesystem::path& folder, const std::string& title, const Sweep& sweep, const SweepResult& result,
                     std::span<const dvec3> outermost) {
  const RowCoordinates coordinates = coordinates_of_rows(sweep);
  const std::size_t peak = peak_row(result);
  const auto grid = grid_through_peak(coordinates, plan_cuts(coordinates).quantity, peak);
  const Picture picture = grid ? maps(title, *grid, coordinates, result, peak) : curves(title, sweep, result, outermost);
  std::string trouble;
  for (const char* name : {"rcs.png", "rcs.svg"})
    if (trouble.empty()) trouble = draw_picture(folder / name, picture.size, picture.commands);
  return trouble.empty() ? "" : fmt::format("no picture: {}; rcs.csv holds the same numbers", trouble);
}

}  // namespace raytube
