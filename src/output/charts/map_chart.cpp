#include "output/charts/map_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "output/charts/chart_style.h"
#include "output/charts/ordinate.h"
#include "output/charts/sphere_map.h"
#include "output/plots/curves.h"
#include "output/plots/gnuplot.h"
#include "output/plots/map_dots.h"

namespace raytube {

namespace {

constexpr double map_range_db = 50.0;  // below the peak, as measured maps are shown
constexpr double flattest = 3.0;       // a window flatter or higher than this fills its panel
constexpr double cross_polar_range_db = 20.0;
constexpr double usual_aspect = 1.6;
constexpr double no_level = std::numeric_limits<double>::quiet_NaN();

SweepMap transposed(const SweepMap& map) {
  SweepMap other{map.up, map.across, map.y, map.x, {}, map.fixed, map.held};
  for (std::size_t i = 0; i < map.x.size(); ++i)
    for (std::size_t j = 0; j < map.y.size(); ++j) other.rows.push_back(map.rows[j * map.x.size() + i]);
  return other;
}

bool is_azimuth(RowCoordinates::Quantity q) { return q == RowCoordinates::phi || q == RowCoordinates::rx_phi; }
bool is_polar(RowCoordinates::Quantity q) { return q == RowCoordinates::theta || q == RowCoordinates::rx_theta; }

std::vector<double> map_levels(const ChartResult& result, const SweepMap& map, std::size_t channel) {
  std::vector<double> levels;
  for (const std::size_t row : map.rows) levels.push_back(row == SweepMap::hole ? no_level : result.sigma_dbsm[channel][row]);
  return levels;
}

Ordinate colours_of(const ChartResult& result, const SweepMap& map, const std::vector<std::size_t>& channels,
                    const ChartOptions& options) {
  double lowest = std::numeric_limits<double>::infinity(), peak = -lowest;
  for (const std::size_t c : channels)
    for (const double level : map_levels(result, map, c)) lowest = std::fmin(lowest, level), peak = std::fmax(peak, level);
  Ordinate axis = ordinate(options, peak, lowest, map_range_db);
  if (!axis.decibels()) return axis;
  axis.top = std::ceil(options.unit == ChartUnit::dbsm ? axis.peak_dbsm : 0.0);
  if (!options.range_db) axis.bottom = std::max(axis.bottom, axis.top - map_range_db);
  return axis;
}

// What a map is drawn on: the whole sphere, a window in its true form, or plain axes.
struct MapForm {
  bool sphere;
  std::optional<double> aspect;  // width to height that must be kept
};

MapForm form_of(const SweepMap& map) {
  if (covers_sphere(map)) return {true, sphere_frame(map).aspect()};
  if (!is_azimuth(map.across) || !is_polar(map.up)) return {false, {}};
  const double middle = 0.5 * (map.y.front() + map.y.back()) * degree;
  const double aspect = (map.x.back() - map.x.front()) * std::abs(std::sin(middle)) / (map.y.back() - map.y.front());
  return {false, aspect > 1.0 / flattest && aspect < flattest ? std::optional(aspect) : std::nullopt};
}

// Panels in one column or two, between margins that hold heading, labels and the box of colours. In pixels, from above.
struct PanelGrid {
  static constexpr double left = 95, right = 150, top = 105, bottom = 70, gap_across = 100, gap_down = 110;
  std::size_t columns, lines;
  std::array<double, 2> canvas{};
  std::optional<double> aspect;

  double cell_width() const {
    return (canvas[0] - left - right - static_cast<double>(columns - 1) * gap_across) / static_cast<double>(columns);
  }
  double cell_height() const {
    return (canvas[1] - top - bottom - static_cast<double>(lines - 1) * gap_down) / static_cast<double>(lines);
  }

  // The panel inside its cell, in its true form.
  double width() const { return aspect ? std::min(cell_width(), cell_height() * *aspect) : cell_width(); }
  double height() const { return aspect ? width() / *aspect : cell_height(); }

  std::string place(std::size_t number) const {
    const double x = left + static_cast<double>(number % columns) * (cell_width() + gap_across) + 0.5 * (cell_width() - width());
    const double y = top + static_cast<double>(number / columns) * (cell_height() + gap_down) + 0.5 * (cell_height() - height());
    return fmt::format(
        "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\nset tmargin at screen {:.5f}\nset bmargin at screen "
        "{:.5f}\n",
        x / canvas[0], (x + width()) / canvas[0], 1.0 - y / canvas[1], 1.0 - (y + height()) / canvas[1]);
  }

  // As high as the panels together.
  std::string color_box() const {
    const double beside = 0.5 * (cell_height() - height());
    return fmt::format("set colorbox vertical user origin screen {:.5f}, screen {:.5f} size screen {:.5f}, screen {:.5f}\n",
                       1.0 - (right - 30.0) / canvas[0], (bottom + beside) / canvas[1], 22.0 / canvas[0],
                       1.0 - (top + bottom + 2.0 * beside) / canvas[1]);
  }
};

PanelGrid panel_grid(std::size_t panels, std::size_t columns, std::optional<double> aspect, const ChartOptions& options) {
  PanelGrid grid{columns, (panels + columns - 1) / columns, {}, aspect};
  const double width = panels == 1 ? 860.0 : 560.0, height = std::clamp(width / aspect.value_or(usual_aspect), 180.0, 640.0);
  const double across = static_cast<double>(grid.columns), lines = static_cast<double>(grid.lines);
  grid.canvas = laid_out({PanelGrid::left + PanelGrid::right + across * width + (across - 1.0) * PanelGrid::gap_across,
                          PanelGrid::top + PanelGrid::bottom + lines * height + (lines - 1.0) * PanelGrid::gap_down},
                         options);
  return grid;
}

// In two columns, unless the picture is asked for in a form in which one holds larger panels.
PanelGrid panel_grid(std::size_t panels, std::optional<double> aspect, const ChartOptions& options) {
  const PanelGrid one = panel_grid(panels, 1, aspect, options), two = panel_grid(panels, 2, aspect, options);
  const auto share = [](const PanelGrid& grid) { return grid.width() * grid.height() / (grid.canvas[0] * grid.canvas[1]); };
  return panels == 1 || (options.size && share(one) > share(two)) ? one : two;
}

std::string matrix_text(const std::vector<double>& dots, std::size_t across) {
  std::string text;
  for (std::size_t i = 0; i < dots.size(); ++i)
    text += (std::isnan(dots[i]) ? "NaN" : fmt::format("{:.5g}", dots[i])) + ((i + 1) % across == 0 ? '\n' : ' ');
  return text;
}

std::vector<double> in_unit(std::vector<double> dots, const Ordinate& axis) {
  for (double& dot : dots)
    if (!std::isnan(dot)) dot = std::max(axis.of(dot), axis.bottom);
  return dots;
}

// Data and commands of one channel.
struct PanelScript {
  std::string data, plot;
};

PanelScript plane_panel(std::size_t channel, const SweepMap& map, const std::vector<double>& levels, const Ordinate& axis) {
  const DotAxis across = dots_across(map), up = dots_up(map);
  const std::string data = fmt::format("$map{} << EOD\n{}EOD\n", channel,
                                       matrix_text(in_unit(map_dots(map, levels, across, up), axis), across.values.size()));
  return {data, fmt::format("plot $map{} using ({}+{}*$1):({}+{}*$2):3 matrix with image notitle\n", channel, across.first,
                            across.step, up.first, up.step)};
}

PanelScript sphere_panel(std::size_t channel, const SweepMap& map, const std::vector<double>& levels, const Ordinate& axis) {
  const SphereMap sphere = sphere_map(map, levels);
  const dvec2 step = (sphere.high - sphere.low) / dvec2(static_cast<double>(sphere.across), static_cast<double>(sphere.up));
  const std::string data = fmt::format("$map{} << EOD\n{}EOD\n", channel, matrix_text(in_unit(sphere.dots, axis), sphere.across));
  return {data, fmt::format("plot $map{} using ({:.6f}+{:.8f}*$1):({:.6f}+{:.8f}*$2):3 matrix with image notitle, \\\n"
                            "     $graticule with lines ls 1 notitle, $outline with lines lc rgb '#808080' lw 1 notitle\n",
                            channel, sphere.low.x + 0.5 * step.x, step.x, sphere.low.y + 0.5 * step.y, step.y)};
}

std::string sphere_axes(const SweepMap& map, bool print) {
  const SphereMap sphere = sphere_frame(map);
  return fmt::format(
      "unset border\nunset xtics\nunset ytics\nset style textbox opaque margins 0.3,0.3 fillcolor rgb 'white' noborder\n"
      "set style line 1 lc rgb '{}' lw 1\nset xrange [{:.5f}:{:.5f}]\nset yrange [{:.5f}:{:.5f}]\n{}",
      print ? "#a0808080" : "#a0ffffff", sphere.low.x, sphere.high.x, sphere.low.y, sphere.high.y, graticule_labels(map));
}

// Polar angles beside azimuths descend, so that the upper side of the target is above.
std::string plane_axes(const SweepMap& map) {
  const DotAxis across = dots_across(map), up = dots_up(map);
  const bool down = is_azimuth(map.across) && is_polar(map.up);
  return fmt::format("set xtics out nomirror\nset ytics out nomirror\n{}{}set xrange [{}:{}]\nset yrange [{}:{}]\n",
                     angle_tics('x', map.across, across.high() - across.low(), 60.0),
                     angle_tics('y', map.up, up.high() - up.low(), 30.0), across.low(), across.high(),
                     down ? up.high() : up.low(), down ? up.low() : up.high());
}

std::string panel_labels(std::size_t number, const SweepMap& map, bool sphere, const PanelGrid& grid) {
  if (sphere) return "";
  return fmt::format("set xlabel '{}'\nset ylabel '{}'\n", axis_label(map.across),
                     number % grid.columns == 0 ? axis_label(map.up) : "");
}

std::string sphere_lines(const SweepMap& map) {
  return fmt::format("$graticule << EOD\n{}EOD\n$outline << EOD\n{}EOD\n", graticule(map), outline(map));
}

// All data come before the panels: gnuplot takes none in between.
PanelScript all_panels(const ChartResult& result, const SweepMap& map, const std::vector<std::size_t>& channels,
                       const Ordinate& axis, const PanelGrid& grid, bool sphere) {
  PanelScript all;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::vector<double> levels = map_levels(result, map, channels[i]);
    const PanelScript panel = (sphere ? sphere_panel : plane_panel)(channels[i], map, levels, axis);
    all.data += panel.data;
    all.plot += grid.place(i) + (i == 0 ? grid.color_box() : "unset colorbox\n");
    all.plot += fmt::format("set title '{}'\n", channel_titles[channels[i]]) + panel_labels(i, map, sphere, grid) + panel.plot;
  }
  return all;
}

std::string peak_text(const ChartResult& result, const std::vector<std::size_t>& channels) {
  const auto strongest =
      *std::ranges::max_element(channels, {}, [&](std::size_t c) { return result.sigma_dbsm[c][result.peak_row]; });
  return fmt::format("peak {:.1f} dBsm, {}, at {}", result.sigma_dbsm[strongest][result.peak_row], channel_titles[strongest],
                     coordinates_text(result.coordinates, result.peak_row));
}

std::string map_title(const ChartResult& result, const SweepMap& map, const std::vector<std::size_t>& channels,
                      const ChartOptions& options) {
  const bool whole = map.held == result.coordinates.rows.size();
  return fmt::format("{}\n{}{}", options.title, whole ? "" : fmt::format("rows at {}, through the peak; ", map.fixed),
                     peak_text(result, channels));
}

}  // namespace

std::optional<SweepMap> chart_map(const ChartResult& result, std::size_t most_cuts) {
  const auto map = map_through(result.peak_row, result.coordinates, result.plan, most_cuts);
  return map && is_azimuth(map->up) && is_polar(map->across) ? transposed(*map) : map;
}

std::vector<std::size_t> channels_with_maps(const ChartResult& result, std::vector<std::size_t> channels) {
  const double least = result.peak_dbsm(channels) - cross_polar_range_db;
  std::erase_if(channels, [&](std::size_t c) { return (c == 1 || c == 2) && result.peak_dbsm({&c, 1}) < least; });
  return channels;
}

Chart map_chart(const ChartResult& result, const SweepMap& map, const std::vector<std::size_t>& channels,
                const ChartOptions& options) {
  const auto [sphere, aspect] = form_of(map);
  const PanelGrid grid = panel_grid(channels.size(), aspect, options);
  const Ordinate axis = colours_of(result, map, channels, options);
  const PanelScript panels = all_panels(result, map, channels, axis, grid, sphere);
  Chart chart{grid.canvas, options.size, (sphere ? sphere_lines(map) : "") + panels.data + map_palette(options.print)};
  chart.commands += fmt::format("set cbrange [{}:{}]\nset cblabel '{}' offset 1,0\nunset key\nunset grid\n{}", axis.bottom,
                                axis.top, axis.label(), sphere ? sphere_axes(map, options.print) : plane_axes(map));
  chart.commands += fmt::format("set multiplot title {}\n{}unset multiplot\n",
                                gnuplot_quoted_lines(map_title(result, map, channels, options)), panels.plot);
  return chart;
}

}  // namespace raytube
