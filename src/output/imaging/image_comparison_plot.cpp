#include "output/imaging/image_comparison_plot.h"

#include <fmt/format.h>

#include <cmath>

#include "output/imaging/level_panels.h"
#include "output/plots/curves.h"
#include "output/plots/gnuplot.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

EvenAxis shown(const EvenAxis& axis, const AxisMap& map) {
  return {axis.at(map.first), axis.count > 1 ? axis.step : 1.0, map.count};
}

// Of what is left when one is taken from the other; without phase those of magnitudes.
std::vector<double> difference_levels(const ChannelPair& pair) {
  std::vector<double> levels;
  for (std::size_t i = 0; i < pair.result.size(); ++i) levels.push_back(sigma_dbsm(pair.result[i] - pair.reference[i]));
  return levels;
}

std::string heading(const ImageComparison& c) {
  const std::string shift = c.registered
                                ? fmt::format("registered: {:+.3f} columns, {:+.3f} rows", c.shift.x + 0.0, c.shift.y + 0.0)
                                : "not registered";
  return fmt::format("{} against {}\n{}", c.result.file.string(), c.reference.file.string(), shift);
}

LevelPanels panels_of(const ImageComparison& c) {
  const bool placed = c.reference.placed;
  LevelPanels drawn{.heading = heading(c),
                    .x = {shown(c.reference.across, c.map.across), placed ? "across (m)" : "column"},
                    .y = {shown(c.reference.up, c.map.up), placed ? "up (m)" : "row"},
                    .alike = true,
                    .level_label = "σ (dBsm)",
                    .range = 40.0,
                    .panels = {},
                    .in_a_row = 3};
  for (std::size_t channel = 0; channel < 4; ++channel) {
    if (!c.signal[channel]) continue;
    const ChannelPair& pair = c.pairs[channel];
    const std::string title = channel_titles[channel];
    drawn.panels.push_back({title + " result", pair.result_dbsm});
    drawn.panels.push_back({title + " reference", pair.reference_dbsm});
    drawn.panels.push_back({title + " result − reference", difference_levels(pair)});
  }
  return drawn;
}

}  // namespace

std::string plot_comparison(const std::filesystem::path& folder, const ImageComparison& c) {
  const std::filesystem::path picture = folder / "compare.png";
  const std::string trouble = draw_picture(picture, level_panels_script("pngcairo", picture.string(), panels_of(c)));
  return trouble.empty() ? "" : fmt::format("no plot: {}; compare.csv holds the measures", trouble);
}

}  // namespace raytube
