#include "output/plots/comparison_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/decimal.h"
#include "output/plots/curves.h"
#include "output/plots/gnuplot.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr std::size_t most_columns = 3;

// Line styles 11 to 14: the reference, pale and broad underneath; 21 to 24: differences where the reference is low.
constexpr std::array<const char*, 4> pale = {"#a9c4ea", "#aeddb5", "#ebc0eb", "#f4bfa4"};

// One column of the picture.
struct Pair {
  Cut result, reference;
  std::array<std::vector<double>, 4> difference, near_peak;  // NaN: not drawn
};

std::string pale_styles() {
  std::string text;
  for (int channel = 0; channel < 4; ++channel)
    text += fmt::format("set style line {} lc rgb '{}' lw 7 pt 7 ps 1.6\nset style line {} lc rgb '{}' lw 1.5 pt 7 ps 0.4\n",
                        channel + 11, pale[channel], channel + 21, pale[channel]);
  return text;
}

void add_row(Pair& pair, const Comparison& c, int channel, std::size_t row) {
  const double result = c.pairs[channel].result_dbsm[row], reference = c.pairs[channel].reference_dbsm[row];
  // Against a null the difference is endless; the floor keeps its line in one piece.
  const double peak = c.errors[channel].reference_peak_dbsm, floor = peak - dynamic_range_db;
  const double difference = std::max(result, floor) - std::max(reference, floor);
  pair.result.sigma_dbsm[channel].push_back(result);
  pair.reference.sigma_dbsm[channel].push_back(reference);
  pair.difference[channel].push_back(difference);
  pair.near_peak[channel].push_back(reference >= peak - c.within_db ? difference : ErrorMeasures::undefined);
}

Pair pair_of(const CutRows& rows, const Comparison& c) {
  Pair pair{{rows.fixed, rows.x, {}}, {rows.fixed, rows.x, {}}, {}, {}};
  for (const std::size_t row : rows.rows)
    for (int channel = 0; channel < 4; ++channel)
      if (c.signal[channel]) add_row(pair, c, channel, row);
  return pair;
}

Scale common_scale(const std::vector<Pair>& pairs) {
  std::vector<Cut> cuts;
  for (const Pair& pair : pairs) cuts.push_back(pair.result), cuts.push_back(pair.reference);
  return scale_of(cuts);
}

// Half the height of the lower panels: the largest difference near the peaks and a little more, unless that would flatten the
// rest.
double difference_range(const std::vector<Pair>& pairs) {
  double largest = 0.0;
  for (const Pair& pair : pairs)
    for (const auto& channel : pair.near_peak)
      for (const double value : channel)
        if (!std::isnan(value)) largest = std::max(largest, std::abs(value));
  return largest > 0.0 ? std::min(1.15 * largest, 20.0) : 1.0;
}

std::string data_block(std::size_t number, const Pair& pair, const Comparison& c, const Scale& scale) {
  std::string text = fmt::format("$cut{} << EOD\n", number);
  for (std::size_t i = 0; i < pair.result.x.size(); ++i) {
    text += number_text(pair.result.x[i]);
    for (int channel = 0; channel < 4; ++channel) {
      if (!c.signal[channel]) {
        text += " NaN NaN NaN NaN";
        continue;
      }
      text += ' ' + shown_level(pair.reference.sigma_dbsm[channel][i], scale) + ' ' +
              shown_level(pair.result.sigma_dbsm[channel][i], scale);
      for (const double value : {pair.difference[channel][i], pair.near_peak[channel][i]})
        text += std::isnan(value) ? " NaN" : fmt::format(" {:.6g}", value);
    }
    text += '\n';
  }
  return text + "EOD\n";
}

// Two curves a channel, whose data stand in the given columns of its four, the first one underneath.
std::string panel(std::size_t number, const Pair& pair, const Comparison& c, std::array<int, 2> columns,
                  std::array<int, 2> styles, std::array<const char*, 2> titles) {
  std::string text = xrange_of(pair.result) + "plot NaN notitle";
  for (const int layer : {0, 1})
    for (int channel = 0; channel < 4; ++channel)
      if (c.signal[channel])
        text += fmt::format(", \\\n     $cut{} using 1:{} with {} ls {} title '{}{}'", number, 4 * channel + columns[layer],
                            layer == 0 && pair.result.x.size() > 1 ? "lines" : curve_style(pair.result.x.size()),
                            styles[layer] + channel, channel_titles[channel], titles[layer]);
  return text + '\n';
}

std::string column(std::size_t number, const Pair& pair, const Comparison& c, const Scale& scale, double range) {
  std::string text = "set title " + gnuplot_quoted(pair.result.fixed) + '\n';
  text += fmt::format("set ylabel 'σ (dBsm)'\nset yrange [{}:{}]\n", scale.bottom, scale.top);
  text += panel(number, pair, c, {2, 3}, {11, 1}, {" reference", " result"});
  text += fmt::format("set title ''\nset ylabel 'result − reference (dB)'\nset yrange [{}:{}]\n", -range, range);
  const std::string low = fmt::format(", > {:g} dB below peak", c.within_db);
  return text + panel(number, pair, c, {4, 5}, {21, 1}, {low.c_str(), ""});
}

std::string heading(const Comparison& c, std::size_t shown) {
  const std::string text = fmt::format("{} against {}", c.result.file.string(), c.reference.file.string());
  return shown == c.cuts.cuts.size() ? text : fmt::format("{} ({} of {} cuts)", text, shown, c.cuts.cuts.size());
}

}  // namespace

std::string comparison_plot_script(const std::string& terminal, const std::string& file, const Comparison& c) {
  std::vector<Pair> pairs;
  for (const std::size_t i : spread_choice(c.cuts.cuts.size(), most_columns)) pairs.push_back(pair_of(c.cuts.cuts[i], c));
  const Scale scale = common_scale(pairs);
  const double range = difference_range(pairs);
  std::string script =
      gnuplot_preamble(terminal, fmt::format("{},900", 300 + 800 * pairs.size()), file) + channel_styles + pale_styles();
  script +=
      fmt::format("set rmargin 30\nset lmargin 11\nset key at graph 1.02, graph 1 left top\nset xlabel '{}'\n", c.cuts.axis);
  for (std::size_t i = 0; i < pairs.size(); ++i) script += data_block(i, pairs[i], c, scale);
  script +=
      fmt::format("set multiplot layout 2,{} columnsfirst title {}\n", pairs.size(), gnuplot_quoted(heading(c, pairs.size())));
  for (std::size_t i = 0; i < pairs.size(); ++i) script += column(i, pairs[i], c, scale, range);
  return script + "unset multiplot\nset output\n";
}

std::string plot_comparison(const std::filesystem::path& folder, const Comparison& c) {
  const std::string trouble = draw_pictures(folder, "compare", [&](const std::string& terminal, const std::string& file) {
    return comparison_plot_script(terminal, file, c);
  });
  return trouble.empty() ? "" : fmt::format("no plot: {}; compare.csv holds the measures", trouble);
}

}  // namespace raytube
