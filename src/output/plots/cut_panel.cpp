#include "output/plots/cut_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/decimal.h"
#include "output/plots/gnuplot.h"
#include "output/tables/sampled_rows.h"

namespace raytube {

namespace {

std::string points_data(const Cut& cut, const Scale& scale) {
  std::string text;
  for (std::size_t i = 0; i < cut.x.size(); ++i) {
    text += number_text(cut.x[i]);
    for (const auto& channel : cut.sigma_dbsm) text += ' ' + shown_level(channel[i], scale);
    text += '\n';
  }
  return text;
}

// Three columns a channel.
std::string sectors_data(const SlidingSectors& sectors, const Scale& scale) {
  std::string text;
  for (std::size_t i = 0; i < sectors.x.size(); ++i) {
    text += number_text(sectors.x[i]);
    for (const auto& channel : sectors.levels)
      for (const double level : {channel[i].low, channel[i].median, channel[i].high}) text += ' ' + shown_level(level, scale);
    text += '\n';
  }
  return text;
}

std::string plain_curves(std::size_t number, const DrawnCut& drawn, const Scale& scale) {
  std::string text;
  for (const int channel : {0, 1, 2, 3})
    text += is_shown(drawn.cut, channel, scale)
                ? fmt::format(", \\\n     $cut{} using 1:{} with {} ls {} title '{}'", number, channel + 2,
                              curve_style(drawn.cut.x.size(), drawn.joined), channel + 1, channel_titles[channel])
                : channel_below(channel, drawn.joined, scale);
  return text;
}

// Bands of the co-polar channels alone: four upon one another could not be told apart.
std::string bands(std::size_t number, const DrawnCut& drawn, const Scale& scale) {
  std::string text;
  for (const int channel : {0, 3})
    if (is_shown(drawn.cut, channel, scale))
      text += fmt::format(
          ", \\\n     $sectors{} using 1:{}:{} with filledcurves ls {} fs transparent solid 0.2 noborder title '{} 10–90 %'",
          number, 3 * channel + 2, 3 * channel + 4, channel + 1, channel_titles[channel]);
  return text;
}

std::string dots_and_medians(std::size_t number, const DrawnCut& drawn, const Scale& scale) {
  std::string dots, medians;
  for (const int channel : {0, 1, 2, 3}) {
    if (!is_shown(drawn.cut, channel, scale)) {
      medians += channel_below(channel, true, scale);
      continue;
    }
    dots += fmt::format(", \\\n     $cut{} using 1:{} with points ls {} pt 7 ps 0.25 notitle", number, channel + 2, channel + 1);
    medians += fmt::format(", \\\n     $sectors{} using 1:{} with lines ls {} title '{} median'", number, 3 * channel + 3,
                           channel + 1, channel_titles[channel]);
  }
  return dots + bands(number, drawn, scale) + medians + each_row_entry;
}

std::string note_of(const DrawnCut& drawn) {
  if (drawn.joined) return "";
  return drawn.sectors ? "steps too wide for the lobes: what sliding sectors hold"
                       : "points not joined: steps too wide for the lobes";
}

}  // namespace

DrawnCut drawn_cut(Cut cut, const Sweep& sweep, std::span<const dvec3> outermost) {
  const bool joined = can_be_joined(sweep, outermost, cut.rows);
  std::optional<SlidingSectors> sectors = joined ? std::nullopt : sliding_sectors(cut);
  return {std::move(cut), joined, std::move(sectors)};
}

bool is_shown(const Cut& cut, int channel, const Scale& scale) {
  return std::ranges::max(cut.sigma_dbsm[static_cast<std::size_t>(channel)]) >= scale.floor;
}

std::string channel_below(int channel, bool joined, const Scale& scale) {
  return fmt::format(", \\\n     keyentry with {} ls {} title '{} < {:.0f} dBsm'", joined ? "lines" : "points", channel + 1,
                     channel_titles[channel], scale.floor);
}

std::string width_text(const DrawnCut& drawn) {
  return fmt::format("{:.4g}{}", drawn.sectors->width, drawn.cut.quantity == RowCoordinates::frequency ? " GHz" : "°");
}

std::string cut_data(std::size_t number, const DrawnCut& drawn, const Scale& scale) {
  std::string text = fmt::format("$cut{} << EOD\n{}EOD\n", number, points_data(drawn.cut, scale));
  if (drawn.sectors) text += fmt::format("$sectors{} << EOD\n{}EOD\n", number, sectors_data(*drawn.sectors, scale));
  return text;
}

std::string cut_panel(std::size_t number, const DrawnCut& drawn, const Scale& scale) {
  const std::string note = note_of(drawn), separator = drawn.cut.fixed.empty() || note.empty() ? "" : "; ";
  std::string text = "set title " + gnuplot_quoted(drawn.cut.fixed + separator + note) + "\n";
  text += drawn.sectors ? fmt::format("set key title 'sectors of {}'\n", width_text(drawn)) : "set key notitle\n";
  text += xrange_of(drawn.cut) + "plot NaN notitle";
  text += drawn.sectors ? dots_and_medians(number, drawn, scale) : plain_curves(number, drawn, scale);
  return text + '\n';
}

}  // namespace raytube
