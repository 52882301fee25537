#include "output/plots/plot.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/decimal.h"
#include "output/plots/curves.h"
#include "output/plots/gnuplot.h"
#include "output/tables/cuts.h"
#include "output/tables/sampled_rows.h"

namespace raytube {

namespace {

constexpr std::size_t most_panels = 4;

std::string data_block(std::size_t number, const Cut& cut, const Scale& scale) {
  std::string text = fmt::format("$cut{} << EOD\n", number);
  for (std::size_t i = 0; i < cut.x.size(); ++i) {
    text += number_text(cut.x[i]);
    for (const auto& channel : cut.sigma_dbsm) text += ' ' + shown_level(channel[i], scale);
    text += '\n';
  }
  return text + "EOD\n";
}

std::string curve(std::size_t number, int channel, const Cut& cut, const Scale& scale, bool joined) {
  const auto& values = cut.sigma_dbsm[channel];
  const std::string title = channel_titles[channel], style = curve_style(cut.x.size(), joined);
  if (*std::max_element(values.begin(), values.end()) < scale.floor)
    return fmt::format("keyentry with {} ls {} title '{} < {:.0f} dBsm'", joined ? "lines" : "points", channel + 1, title,
                       scale.floor);
  return fmt::format("$cut{} using 1:{} with {} ls {} title '{}'", number, channel + 2, style, channel + 1, title);
}

std::string panel(std::size_t number, const Cut& cut, const Scale& scale, bool joined) {
  const std::string note = joined ? "" : "points not joined: steps too wide for the lobes";
  std::string text = "set title " + gnuplot_quoted(cut.fixed + (cut.fixed.empty() || joined ? "" : "; ") + note) + "\n";
  text += xrange_of(cut) + "plot NaN notitle";
  for (const int channel : {0, 1, 2, 3}) text += ", \\\n     " + curve(number, channel, cut, scale, joined);
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
                            const SweepResult& result, std::span<const dvec3> outermost) {
  const Cuts cuts = choose_cuts(sweep, result, most_panels);
  const Scale scale = scale_of(cuts.cuts);
  std::string script = gnuplot_preamble(terminal, canvas(cuts.cuts.size()), file) + channel_styles;
  script += fmt::format("set xlabel '{}'\nset ylabel 'σ (dBsm)'\nset yrange [{}:{}]\n", cuts.axis, scale.bottom, scale.top);
  for (std::size_t i = 0; i < cuts.cuts.size(); ++i) script += data_block(i, cuts.cuts[i], scale);
  script += fmt::format("set multiplot layout {} title {}\n", layout(cuts.cuts.size()), gnuplot_quoted(heading(title, cuts)));
  for (std::size_t i = 0; i < cuts.cuts.size(); ++i) {
    const Cut& cut = cuts.cuts[i];
    script += panel(i, cut, scale, can_be_joined(sweep, outermost, cut.rows));
  }
  return script + "unset multiplot\nset output\n";
}

std::string plot_rcs(const std::filesystem::path& folder, const std::string& title, const Sweep& sweep, const SweepResult& result,
                     std::span<const dvec3> outermost) {
  const std::string trouble = draw_pictures(folder, "rcs", [&](const std::string& terminal, const std::string& file) {
    return rcs_plot_script(terminal, file, title, sweep, result, outermost);
  });
  return trouble.empty() ? "" : fmt::format("no plot: {}; rcs.csv holds the same curves", trouble);
}

}  // namespace raytube
