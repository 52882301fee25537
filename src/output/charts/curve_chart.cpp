#include "output/charts/curve_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/decimal.h"
#include "core/error.h"
#include "output/charts/chart_style.h"
#include "output/charts/ordinate.h"
#include "output/plots/curves.h"
#include "output/plots/gnuplot.h"

namespace raytube {

namespace {

constexpr std::size_t most_cut_panels = 4;
constexpr double curves_range_db = 80.0;  // deeper than any measurement; below it lie nulls and rounding dust

void require_one_axis(const std::vector<ChartResult>& results) {
  for (const ChartResult& result : results)
    if (result.plan.quantity != results.front().plan.quantity)
      throw InputError(fmt::format("{} is a sweep over {}, {} one over {}; plot them one by one", results.front().file.string(),
                                   results.front().plan.axis, result.file.string(), result.plan.axis));
}

const CutRows* cut_at(const ChartResult& result, const std::string& fixed) {
  const auto found = std::ranges::find(result.plan.cuts, fixed, &CutRows::fixed);
  return found == result.plan.cuts.end() ? nullptr : &*found;
}

// The first result's cuts that all the others have, too.
std::vector<CutRows> shared_cuts(const std::vector<ChartResult>& results) {
  std::vector<CutRows> shared;
  for (const CutRows& cut : results.front().plan.cuts)
    if (std::ranges::all_of(results, [&](const ChartResult& result) { return cut_at(result, cut.fixed) != nullptr; }))
      shared.push_back(cut);
  if (!shared.empty()) return shared;
  throw InputError(fmt::format("no cut of {} ({} ...) is in all other results; plot them one by one, or run the same sweep",
                               results.front().file.string(), results.front().plan.cuts.front().fixed));
}

CutPanel one_cut_each(const std::vector<ChartResult>& results) {
  CutPanel panel;
  for (std::size_t i = 0; i < results.size(); ++i) {
    panel.cuts.push_back({i, results[i].plan.cuts.front()});
    panel.fixed_differs |= panel.cuts.back().rows.fixed != panel.cuts.front().rows.fixed;
  }
  if (!panel.fixed_differs) panel.title = panel.cuts.front().rows.fixed;
  return panel;
}

struct SpanOfX {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

SpanOfX span_of(const CutPanel& panel) {
  SpanOfX span;
  for (const ChartCut& cut : panel.cuts) {
    span.low = std::min(span.low, cut.rows.x.front());
    span.high = std::max(span.high, cut.rows.x.back());
  }
  if (span.low == span.high) span.low -= 1.0, span.high += 1.0;
  return span;
}

Ordinate curves_ordinate(const std::vector<CutPanel>& panels, const std::vector<ChartResult>& results,
                         const std::vector<std::size_t>& channels, const ChartOptions& options) {
  std::vector<double> levels;
  for (const CutPanel& panel : panels)
    for (const ChartCut& cut : panel.cuts)
      for (const std::size_t c : channels)
        for (const std::size_t row : cut.rows.rows) levels.push_back(results[cut.result].sigma_dbsm[c][row]);
  const double peak = std::ranges::max(levels);
  double lowest = peak;
  for (const double level : levels)
    if (level >= peak - curves_range_db) lowest = std::min(lowest, level);
  return ordinate(options, peak, lowest, curves_range_db);
}

std::string curve_data(std::size_t number, const ChartCut& cut, const ChartResult& result,
                       const std::vector<std::size_t>& channels, const Ordinate& axis) {
  std::string text = fmt::format("$curves{} << EOD\n", number);
  for (std::size_t i = 0; i < cut.rows.rows.size(); ++i) {
    text += number_text(cut.rows.x[i]);
    for (const std::size_t c : channels) text += fmt::format(" {:.6g}", axis.of(result.sigma_dbsm[c][cut.rows.rows[i]]));
    text += '\n';
  }
  return text + "EOD\n";
}

// A block of data for each cut, numbered through all panels.
std::string panel_data(std::size_t number, const CutPanel& panel, const std::vector<ChartResult>& results,
                       const std::vector<std::size_t>& channels, const Ordinate& axis) {
  std::string text;
  for (std::size_t i = 0; i < panel.cuts.size(); ++i)
    text += curve_data(number * results.size() + i, panel.cuts[i], results[panel.cuts[i].result], channels, axis);
  return text;
}

std::string curve_panel(std::size_t number, const CutPanel& panel, const std::vector<ChartResult>& results,
                        const std::vector<std::size_t>& channels, bool print) {
  const SpanOfX span = span_of(panel);
  std::string text =
      fmt::format("set title {}\nset xrange [{}:{}]\nplot NaN notitle", gnuplot_quoted(panel.title), span.low, span.high);
  for (std::size_t i = 0; i < panel.cuts.size(); ++i)
    for (std::size_t k = 0; k < channels.size(); ++k) {
      const ChartCut& cut = panel.cuts[i];
      text += fmt::format(", \\\n     $curves{} using 1:{} {} title {}", number * results.size() + i, k + 2,
                          curve_look({cut.result, results.size(), channels[k], cut.rows.x.size(), print}),
                          gnuplot_quoted(curve_title(panel, cut, channels[k], results)));
    }
  return text + '\n';
}

std::string curve_axes(const std::vector<CutPanel>& panels, const ChartResult& first, const Ordinate& axis, std::size_t columns) {
  const SpanOfX span = span_of(panels.front());
  return fmt::format("set xlabel '{}'\nset ylabel '{}'\nset yrange [{}:{}]\n{}", first.plan.axis, axis.label(), axis.bottom,
                     axis.top, angle_tics('x', first.plan.quantity, span.high - span.low, columns == 1 ? 30.0 : 60.0));
}

std::string curves_heading(const std::string& title, const std::vector<CutPanel>& panels,
                           const std::vector<ChartResult>& results) {
  const std::size_t all = results.front().plan.cuts.size();
  if (panels.size() == all || panels.front().fixed_differs) return title;
  return fmt::format("{} ({} of {} cuts, with that through the peak)", title, panels.size(), all);
}

}  // namespace

std::vector<CutPanel> cut_panels(const std::vector<ChartResult>& results, std::size_t most) {
  require_one_axis(results);
  if (results.size() > 1 && std::ranges::all_of(results, [](const ChartResult& r) { return r.plan.cuts.size() == 1; }))
    return {one_cut_each(results)};
  const std::vector<CutRows> shared = shared_cuts(results);
  std::vector<CutPanel> panels;
  for (const std::size_t i : choice_with(shared, results.front().peak_row, most)) {
    CutPanel& panel = panels.emplace_back(CutPanel{shared[i].fixed, {}});
    for (std::size_t r = 0; r < results.size(); ++r) panel.cuts.push_back({r, *cut_at(results[r], panel.title)});
  }
  return panels;
}

std::string curve_title(const CutPanel& panel, const ChartCut& cut, std::size_t channel,
                        const std::vector<ChartResult>& results) {
  if (results.size() == 1) return channel_titles[channel];
  const std::string fixed = panel.fixed_differs ? fmt::format(", {}", cut.rows.fixed) : "";
  return fmt::format("{}{} {}", results[cut.result].name, fixed, channel_titles[channel]);
}

Chart curve_chart(const std::vector<ChartResult>& results, const std::vector<std::size_t>& channels,
                  const ChartOptions& options) {
  const std::vector<CutPanel> panels = cut_panels(results, most_cut_panels);
  const Ordinate axis = curves_ordinate(panels, results, channels, options);
  const std::size_t columns = panels.size() <= 2 ? 1 : 2, lines = panels.size() == 1 ? 1 : 2;
  Chart chart{laid_out({columns == 1 ? 1100.0 : 1700.0, lines == 1 ? 640.0 : 1000.0}, options), options.size, {}};
  for (std::size_t p = 0; p < panels.size(); ++p) chart.commands += panel_data(p, panels[p], results, channels, axis);
  chart.commands += curve_axes(panels, results.front(), axis, columns);
  chart.commands += fmt::format("set multiplot layout {},{} title {}\n", lines, columns,
                                gnuplot_quoted(curves_heading(options.title, panels, results)));
  for (std::size_t p = 0; p < panels.size(); ++p) chart.commands += curve_panel(p, panels[p], results, channels, options.print);
  chart.commands += "unset multiplot\n";
  return chart;
}

}  // namespace raytube
