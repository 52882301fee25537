#include "output/plots/plot.h"

#include <fmt/format.h>

#include <vector>

#include "output/plots/cut_panel.h"
#include "output/plots/gnuplot.h"
#include "output/plots/map_plot.h"
#include "output/plots/polar_plot.h"

namespace raytube {

namespace {

constexpr std::size_t most_panels = 4;

std::string heading(const std::string& title, const Cuts& cuts) {
  if (cuts.cuts.size() == cuts.total) return title;
  return fmt::format("{} ({} of {} cuts, with that through the peak; rcs.csv has all)", title, cuts.cuts.size(), cuts.total);
}

std::string layout(std::size_t panels) { return panels == 1 ? "1,1" : panels == 2 ? "2,1" : "2,2"; }

std::string canvas(std::size_t panels) { return panels == 1 ? "1100,640" : panels == 2 ? "1100,1000" : "1700,1000"; }

std::string cuts_plot_script(const std::string& terminal, const std::string& file, const std::string& title, const Sweep& sweep,
                             const SweepResult& result, std::span<const dvec3> outermost) {
  const Cuts cuts = choose_cuts(sweep, result, most_panels);
  const Scale scale = scale_of(cuts.cuts);
  std::vector<DrawnCut> drawn;
  for (const Cut& cut : cuts.cuts) drawn.push_back(drawn_cut(cut, sweep, outermost));
  std::string script = gnuplot_preamble(terminal, canvas(drawn.size()), file) + channel_styles;
  script += fmt::format("set xlabel '{}'\nset ylabel 'σ (dBsm)'\nset yrange [{}:{}]\n", cuts.axis, scale.bottom, scale.top);
  for (std::size_t i = 0; i < drawn.size(); ++i) script += cut_data(i, drawn[i], scale);
  script += fmt::format("set multiplot layout {} title {}\n", layout(drawn.size()), gnuplot_quoted(heading(title, cuts)));
  for (std::size_t i = 0; i < drawn.size(); ++i) script += cut_panel(i, drawn[i], scale);
  return script + "unset multiplot\nset output\n";
}

}  // namespace

std::string rcs_plot_script(const std::string& terminal, const std::string& file, const std::string& title, const Sweep& sweep,
                            const SweepResult& result, std::span<const dvec3> outermost) {
  const RowCoordinates coordinates = coordinates_of_rows(sweep);
  const auto map = map_through(peak_row(result), coordinates, plan_cuts(coordinates), most_panels);
  return map ? map_plot_script(terminal, file, title, sweep, result, *map, outermost)
             : cuts_plot_script(terminal, file, title, sweep, result, outermost);
}

std::string plot_rcs(const std::filesystem::path& folder, const std::string& title, const Sweep& sweep, const SweepResult& result,
                     std::span<const dvec3> outermost) {
  std::string trouble = draw_pictures(folder, "rcs", [&](const std::string& terminal, const std::string& file) {
    return rcs_plot_script(terminal, file, title, sweep, result, outermost);
  });
  if (trouble.empty() && polar_plot_script("svg", "", title, sweep, result, outermost))
    trouble = draw_pictures(folder, "rcs_polar", [&](const std::string& terminal, const std::string& file) {
      return *polar_plot_script(terminal, file, title, sweep, result, outermost);
    });
  return trouble.empty() ? "" : fmt::format("no plot: {}; rcs.csv holds the same curves", trouble);
}

}  // namespace raytube
