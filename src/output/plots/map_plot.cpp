#include "output/plots/map_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "output/plots/cut_panel.h"
#include "output/plots/gnuplot.h"
#include "output/plots/map_dots.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr double map_range = 50.0;    // [dB] below the peak, as measured maps are shown
constexpr double least_range = 10.0;  // [dB] of the colours: less would show rounding
constexpr double cross_polar_range = 20.0;

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

std::array<std::vector<double>, 4> levels_of_map(const SweepMap& map, const SweepResult& result) {
  std::array<std::vector<double>, 4> levels;
  for (const std::size_t row : map.rows)
    for (int channel = 0; channel < 4; ++channel)
      levels[static_cast<std::size_t>(channel)].push_back(
          row == SweepMap::hole ? not_there : sigma_dbsm(result.total[row].at(channel / 2, channel % 2)));
  return levels;
}

struct ColorRange {
  double bottom, top;
};

ColorRange color_range(const std::array<std::vector<double>, 4>& levels, const std::vector<int>& channels, double peak) {
  if (!std::isfinite(peak)) return {-map_range, 0.0};  // nothing comes back at all
  double lowest = peak;
  for (const int channel : channels)
    for (const double level : levels[static_cast<std::size_t>(channel)]) lowest = std::fmin(lowest, level);
  const double top = std::ceil(peak);
  return {std::clamp(std::floor(lowest), top - map_range, top - least_range), top};
}

struct ChannelMaps {
  DotAxis across, up;
  std::array<std::vector<double>, 4> levels;
  std::vector<int> channels;  // that have a map
  double peak;                // of all channels [dBsm]
  int strongest;              // the channel of the peak
  ColorRange colors;
};

ChannelMaps maps_of(const SweepMap& map, const SweepResult& result) {
  ChannelMaps maps{dots_across(map), dots_up(map), levels_of_map(map, result), {}, 0.0, 0, {}};
  std::array<double, 4> peaks{};
  peaks.fill(not_there);
  for (std::size_t channel = 0; channel < 4; ++channel)
    for (const double level : maps.levels[channel]) peaks[channel] = std::fmax(peaks[channel], level);
  maps.strongest = static_cast<int>(std::ranges::max_element(peaks) - peaks.begin());
  maps.peak = std::ranges::max(peaks);
  const bool cross = std::max(peaks[1], peaks[2]) >= maps.peak - cross_polar_range;
  maps.channels = cross ? std::vector{0, 1, 2, 3} : std::vector{0, 3};
  maps.colors = color_range(maps.levels, maps.channels, maps.peak);
  return maps;
}

// From above: a heading, rows of two maps each, two cuts as wide as both. In pixels.
struct MapLayout {
  double left = 100, width = 520, gap_across = 90, right = 230, top = 110, map_height = 330, gap_down = 112, cut_height = 260,
         bottom = 65;
  double map_rows;

  double across() const { return left + 2 * width + gap_across + right; }
  double down() const { return top + map_rows * (map_height + gap_down) + 2 * cut_height + gap_down + bottom; }
  double map_floor(double row) const { return down() - top - (row + 1) * map_height - row * gap_down; }
  double cut_floor(int cut) const { return bottom + (1 - cut) * (cut_height + gap_down); }

  std::string place(double from, double to, double floor, double height) const {
    return fmt::format("set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\nset tmargin at screen {}\n",
                       from / across(), to / across(), floor / down(), (floor + height) / down());
  }
  std::string map_place(std::size_t number) const {
    const double from = left + static_cast<double>(number % 2) * (width + gap_across);
    return place(from, from + width, map_floor(static_cast<double>(number / 2)), map_height);
  }
  std::string cut_place(int cut) const { return place(left, across() - right, cut_floor(cut), cut_height); }
  std::string color_box() const {
    const double floor = map_floor(map_rows - 1);
    return fmt::format("set colorbox vertical user origin screen {}, screen {} size screen {}, screen {}\n",
                       (across() - right + 30) / across(), floor / down(), 22 / across(), (down() - top - floor) / down());
  }
};

std::string map_data(int channel, const SweepMap& map, const ChannelMaps& maps) {
  const std::vector<double> dots = map_dots(map, maps.levels[static_cast<std::size_t>(channel)], maps.across, maps.up);
  std::string text = fmt::format("$map{} << EOD\n", channel);
  for (std::size_t i = 0; i < dots.size(); ++i) {
    text += std::isnan(dots[i]) ? "NaN " : fmt::format("{:.2f} ", std::max(dots[i], maps.colors.bottom));
    if ((i + 1) % maps.across.values.size() == 0) text += '\n';
  }
  return text + "EOD\n";
}

// Where the cuts below run.
std::string peak_lines(const SweepMap& map, const RowCoordinates& coordinates, std::size_t peak) {
  const double x = coordinates.rows[peak][map.across], y = coordinates.rows[peak][map.up];
  constexpr const char* style = "nohead front lw 1 dt (4,6) lc rgb '#ffffff'";
  return fmt::format(
      "set arrow 1 from {0}, graph 0 to {0}, graph 1 {2}\nset arrow 2 from graph 0, first {1} to graph 1, first {1} {2}\n", x, y,
      style);
}

std::string map_panel(std::size_t number, const SweepMap& map, const ChannelMaps& maps, const MapLayout& layout) {
  const int channel = maps.channels[number];
  std::string text = layout.map_place(number);
  text += fmt::format("set title '{}'\nset xlabel '{}'\nset ylabel '{}'\n", channel_titles[static_cast<std::size_t>(channel)],
                      axis_label(map.across), number % 2 == 0 ? axis_label(map.up) : "");
  text += number == 0 ? layout.color_box() : "unset colorbox\n";
  return text + fmt::format("plot $map{} using ({}+{}*$1):({}+{}*$2):3 matrix with image notitle\n", channel, maps.across.first,
                            maps.across.step, maps.up.first, maps.up.step);
}

std::string map_panels(const SweepMap& map, const ChannelMaps& maps, const MapLayout& layout, const std::string& lines) {
  std::string text = level_palette;
  text += fmt::format(
      "set cbrange [{}:{}]\nset cblabel 'σ (dBsm)'\nunset key\nset xtics out nomirror\nset ytics out nomirror\nset grid noxtics "
      "noytics\n",
      maps.colors.bottom, maps.colors.top);
  text += fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", maps.across.low(), maps.across.high(), maps.up.low(),
                      maps.up.high());
  text += lines;
  for (std::size_t i = 0; i < maps.channels.size(); ++i) text += map_panel(i, map, maps, layout);
  return text +
         "unset arrow\nset xtics in mirror\nset ytics in mirror\nset grid xtics ytics lt 1 lw 1 lc rgb '#d9d9d9'\nset key\n";
}

std::string map_heading(const std::string& title, const SweepMap& map, const ChannelMaps& maps, const std::string& peak,
                        bool whole) {
  const std::string part = whole ? "" : fmt::format("rows at {}, through the peak; rcs.csv has all; ", map.fixed);
  return fmt::format("{}\n{}peak {:.1f} dBsm, {}, at {}", title, part, maps.peak,
                     channel_titles[static_cast<std::size_t>(maps.strongest)], peak);
}

// With a scale of its own: the peak may stand out along one quantity only.
std::string cut_of_map(std::size_t number, const DrawnCut& drawn, const Scale& scale, const MapLayout& layout) {
  return layout.cut_place(static_cast<int>(number)) +
         fmt::format("set xlabel '{}'\nset ylabel 'σ (dBsm)'\nset yrange [{}:{}]\n", axis_label(drawn.cut.quantity), scale.bottom,
                     scale.top) +
         cut_panel(number, drawn, scale);
}

// Data before the panels: gnuplot takes none in between.
struct CutScripts {
  std::string data, panels;
};

CutScripts cuts_through_peak(const SweepMap& map, std::size_t peak, const RowCoordinates& coordinates, const SweepResult& result,
                             const Sweep& sweep, std::span<const dvec3> outermost, const MapLayout& layout) {
  CutScripts scripts;
  std::size_t number = 0;
  for (const auto quantity : {map.across, map.up}) {
    Cut cut = cut_through(peak, quantity, coordinates, result);
    cut.fixed = "through the peak: " + cut.fixed;
    const Scale scale = scale_of({&cut, 1});
    const DrawnCut drawn = drawn_cut(std::move(cut), sweep, outermost);
    scripts.data += cut_data(number, drawn, scale);
    scripts.panels += cut_of_map(number++, drawn, scale, layout);
  }
  return scripts;
}

}  // namespace

std::string map_plot_script(const std::string& terminal, const std::string& file, const std::string& title, const Sweep& sweep,
                            const SweepResult& result, const SweepMap& map, std::span<const dvec3> outermost) {
  const RowCoordinates coordinates = coordinates_of_rows(sweep);
  const std::size_t peak = peak_row(result);
  const ChannelMaps maps = maps_of(map, result);
  const MapLayout layout{.map_rows = static_cast<double>(maps.channels.size()) / 2};
  const CutScripts cuts = cuts_through_peak(map, peak, coordinates, result, sweep, outermost, layout);
  const std::string heading = map_heading(title, map, maps, coordinates_text(coordinates, peak), map.held == sweep.rows());
  std::string script =
      gnuplot_preamble(terminal, fmt::format("{:.0f},{:.0f}", layout.across(), layout.down()), file) + channel_styles + cuts.data;
  for (const int channel : maps.channels) script += map_data(channel, map, maps);
  script += "set multiplot title " + gnuplot_quoted_lines(heading) + '\n';
  script += map_panels(map, maps, layout, peak_lines(map, coordinates, peak)) + cuts.panels;
  return script + "unset multiplot\nset output\n";
}

}  // namespace raytube
