#include "output/statistics/statistics_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/plots/curves.h"
#include "output/plots/gnuplot.h"

namespace raytube {

namespace {

constexpr double curve_step_db = 0.1;

constexpr const char* law_styles =
    "set style line 1 lc rgb '#1f5fbf' lw 2.5\nset style line 2 lc rgb '#2e8b3d' lw 2.5 dt (12,4,2,4)\n"
    "set style line 3 lc rgb '#d9480f' lw 2.5 dt (10,6)\nset style line 4 lc rgb '#8e44ad' lw 2.5 dt (3,4)\n";

constexpr double room_for_key = 1.6;

double bar_height(const Histogram& histogram, const HistogramBin& bin) {
  return 100.0 * static_cast<double>(bin.rows) / (static_cast<double>(histogram.rows) * histogram.width_db);
}

// Of the bars and about of the curves.
double highest_share(const ChannelStatistics& c) {
  double highest = 0.0;
  for (const HistogramBin& bin : c.histogram.bins) {
    if (!std::isfinite(bin.from_dbsm)) continue;
    highest = std::max(highest, bar_height(c.histogram, bin));
    for (const LawFit& law : c.laws) highest = std::max(highest, 100.0 * expected_share(law, bin) / c.histogram.width_db);
  }
  return highest > 0.0 ? highest : 1.0;
}

// Percent of the rows for each decibel; the bar of all that lies below the picture is left out.
std::string bars(const Histogram& histogram, std::size_t channel) {
  std::string text = fmt::format("$bars{} << EOD\n", channel);
  for (const HistogramBin& bin : histogram.bins)
    if (std::isfinite(bin.from_dbsm))
      text += fmt::format("{} {:.6g}\n", 0.5 * (bin.from_dbsm + bin.to_dbsm), bar_height(histogram, bin));
  return text + "EOD\n";
}

std::string curves_of_laws(const ChannelStatistics& c) {
  std::string text = fmt::format("$laws{} << EOD\n", c.channel);
  const double from = c.histogram.bins.front().to_dbsm - c.histogram.width_db, to = c.histogram.bins.back().to_dbsm;
  for (double x = from; x <= to + 0.5 * curve_step_db; x += curve_step_db) {
    text += fmt::format("{:.2f}", x);
    for (const LawFit& law : c.laws)
      text += fmt::format(" {:.5g}",
                          100.0 * (law.below(x + 0.5 * curve_step_db) - law.below(x - 0.5 * curve_step_db)) / curve_step_db);
    text += '\n';
  }
  return text + "EOD\n";
}

std::string law_key(const LawFit& law) {
  const std::string freedom = law.law == Law::chi_square ? fmt::format(", {:.2f} degrees of freedom", 2.0 * law.shape) : "";
  return fmt::format("{}{}: {:.3f}", law_titles[static_cast<std::size_t>(law.law)], freedom, law.distance);
}

std::string distribution_panel(const ChannelStatistics& c) {
  const Histogram& histogram = c.histogram;
  std::string text = fmt::format("set title '{}: {} rows, mean {:.1f} dBsm, median {:.1f} dBsm'\n", channel_titles[c.channel],
                                 c.all.rows, c.all.mean_dbsm(), c.all.median_dbsm);
  text += fmt::format("set xrange [{}:{}]\nset yrange [0:{:.4g}]\nset boxwidth {}\n",
                      histogram.bins.front().to_dbsm - histogram.width_db, histogram.bins.back().to_dbsm,
                      room_for_key * highest_share(c), histogram.width_db);
  text += fmt::format("plot $bars{} with boxes lc rgb '#909090' fs solid 0.35 border title 'rows'", c.channel);
  for (std::size_t i = 0; i < c.laws.size(); ++i)
    text += fmt::format(", \\\n     $laws{} using 1:{} with lines ls {} title '{}'", c.channel, i + 2, i + 1, law_key(c.laws[i]));
  return text + '\n';
}

bool has_histogram(const ChannelStatistics& c) { return !c.histogram.bins.empty(); }

}  // namespace

std::string statistics_plot_script(const std::string& terminal, const std::string& file, const SigmaStatistics& s) {
  std::vector<ChannelStatistics> shown;
  for (const ChannelStatistics& c : s.channels)
    if (has_histogram(c)) shown.push_back(c);
  const std::size_t columns = shown.size() == 1 ? 1 : 2, lines = (shown.size() + 1) / 2;
  std::string script = gnuplot_preamble(terminal, fmt::format("{},{}", 850 * columns, 60 + 500 * lines), file) + law_styles;
  script +=
      "set key inside left top title 'largest difference of shares' left\nset xlabel 'σ (dBsm)'\nset ylabel 'rows (% per dB)'\n";
  for (const ChannelStatistics& c : shown) script += bars(c.histogram, c.channel) + curves_of_laws(c);
  script += fmt::format("set multiplot layout {},{} title {}\n", lines, columns, gnuplot_quoted(s.result.file.string()));
  for (const ChannelStatistics& c : shown) script += distribution_panel(c);
  return script + "unset multiplot\nset output\n";
}

std::string plot_statistics(const std::filesystem::path& folder, const SigmaStatistics& s) {
  if (s.channels.empty() || !has_histogram(s.channels.front())) return "no plot: sigma is zero in every row";
  const std::string trouble = draw_pictures(folder, "statistics", [&](const std::string& terminal, const std::string& file) {
    return statistics_plot_script(terminal, file, s);
  });
  return trouble.empty() ? "" : fmt::format("no plot: {}; histogram.csv holds the numbers", trouble);
}

}  // namespace raytube
