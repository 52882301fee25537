#include "output/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "decimal.h"
#include "output/cuts.h"
#include "output/gnuplot.h"

namespace raytube {

namespace {

constexpr double shown_range_db = 80.0;  // deeper than any measurement; below it lie nulls and rounding dust
constexpr std::size_t most_panels = 4;

// Dashed over solid, so that two equal curves both show.
constexpr const char* line_styles =
    "set style line 1 lc rgb '#1f5fbf' lw 3 pt 7 ps 0.7\n"
    "set style line 2 lc rgb '#2e8b3d' lw 2 pt 5 ps 0.6\n"
    "set style line 3 lc rgb '#c040c0' lw 2 dt (16,16) pt 4 ps 1.1\n"
    "set style line 4 lc rgb '#d9480f' lw 2 dt (10,6) pt 6 ps 1.1\n";
constexpr std::array<const char*, 4> channel_titles = {"VV", "VH", "HV", "HH"};

struct Scale {
  double bottom, top;
  double floor;  // values below are not shown
};

double highest(const Cuts& cuts) {
  double peak = -std::numeric_limits<double>::infinity();
  for (const Cut& cut : cuts.cuts)
    for (const auto& channel : cut.sigma_dbsm)
      for (const double value : channel) peak = std::max(peak, value);
  return peak;
}

double lowest_shown(const Cuts& cuts, double floor) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Cut& cut : cuts.cuts)
    for (const auto& channel : cut.sigma_dbsm)
      for (const double value : channel)
        if (value >= floor) lowest = std::min(lowest, value);
  return lowest;
}

Scale scale_of(const Cuts& cuts) {
  const double peak = highest(cuts);
  if (!std::isfinite(peak)) return {-100.0, 0.0, -100.0};  // nothing comes back at all
  const double floor = peak - shown_range_db;
  return {10.0 * std::floor(lowest_shown(cuts, floor) / 10.0), 5.0 * std::ceil((peak + 2.0) / 5.0), floor};
}

// A value under the floor (a null, or -inf) is moved just out of the picture, so that its line leaves through the bottom.
std::string data_block(std::size_t number, const Cut& cut, const Scale& scale) {
  std::string text = fmt::format("$cut{} << EOD\n", number);
  for (std::size_t i = 0; i < cut.x.size(); ++i) {
    text += number_text(cut.x[i]);
    for (const auto& channel : cut.sigma_dbsm) text += fmt::format(" {:.4f}", std::max(channel[i], scale.bottom - 20.0));
    text += '\n';
  }
  return text + "EOD\n";
}

std::string curve(std::size_t number, int channel, const Cut& cut, const Scale& scale) {
  const auto& values = cut.sigma_dbsm[channel];
  const std::string title = channel_titles[channel];
  if (*std::max_element(values.begin(), values.end()) < scale.floor)
    return fmt::format("keyentry with lines ls {} title '{} < {:.0f} dBsm'", channel + 1, title, scale.floor);
  const char* style = cut.x.size() == 1 ? "points" : cut.x.size() <= 60 ? "linespoints" : "lines";
  return fmt::format("$cut{} using 1:{} with {} ls {} title '{}'", number, channel + 2, style, channel + 1, title);
}

std::string panel(std::size_t number, const Cut& cut, const Scale& scale) {
  std::string text = "set title " + gnuplot_quoted(cut.fixed) + "\n";
  const double margin = cut.x.front() < cut.x.back() ? 0.0 : 1.0;
  text += fmt::format("set xrange [{}:{}]\nplot NaN notitle", cut.x.front() - margin, cut.x.back() + margin);
  for (const int channel : {0, 1, 2, 3}) text += ", \\\n     " + curve(number, channel, cut, scale);
  return text + '\n';
}

std::string heading(const std::string& title, const Cuts& cuts) {
  if (cuts.cuts.size() == cuts.total) return title;
  return fmt::format("{} ({} of {} cuts, rcs.csv has all)", title, cuts.cuts.size(), cuts.total);
}

std::string layout(std::size_t panels) { return panels == 1 ? "1,1" : panels == 2 ? "2,1" : "2,2"; }

std::string canvas(std::size_t panels) { return panels == 1 ? "1100,640" : panels == 2 ? "1100,1000" : "1700,1000"; }

}  // namespace

std::string rcs_plot_script(const std::string& terminal, const std::string& file, const std::string& title, const Sweep& sweep,
                            const SweepResult& result) {
  const Cuts cuts = choose_cuts(sweep, result, most_panels);
  const Scale scale = scale_of(cuts);
  std::string script = gnuplot_preamble(terminal, canvas(cuts.cuts.size()), file) + line_styles;
  script += fmt::format("set xlabel '{}'\nset ylabel 'σ (dBsm)'\nset yrange [{}:{}]\n", cuts.axis, scale.bottom, scale.top);
  for (std::size_t i = 0; i < cuts.cuts.size(); ++i) script += data_block(i, cuts.cuts[i], scale);
  script += fmt::format("set multiplot layout {} title {}\n", layout(cuts.cuts.size()), gnuplot_quoted(heading(title, cuts)));
  for (std::size_t i = 0; i < cuts.cuts.size(); ++i) script += panel(i, cuts.cuts[i], scale);
  return script + "unset multiplot\nset output\n";
}

std::string plot_rcs(const std::filesystem::path& folder, const std::string& title, const Sweep& sweep,
                     const SweepResult& result) {
  const std::string trouble = draw_pictures(folder, "rcs", [&](const std::string& terminal, const std::string& file) {
    return rcs_plot_script(terminal, file, title, sweep, result);
  });
  return trouble.empty() ? "" : fmt::format("no plot: {}; rcs.csv holds the same curves", trouble);
}

}  // namespace raytube
