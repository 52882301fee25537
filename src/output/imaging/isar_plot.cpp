#include "output/imaging/isar_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "output/plots/curves.h"
#include "output/plots/gnuplot.h"
#include "output/imaging/level_panels.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr std::array<const char*, 3> labels = {"range (m)", "cross-range (m)", "height (m)"};

EvenAxis axis_of(const IsarImage& image, std::size_t axis) {
  return {image.coordinate(axis, 0), image.grid.step[axis], image.grid.count[axis]};
}

double level(const IsarImage& image, std::size_t index, int channel) {
  return sigma_dbsm(image.s[index].at(channel / 2, channel % 2));
}

// Cells by two of the axes, [up][across]: of those along a third one the strongest.
std::vector<double> levels_over(const IsarImage& image, std::size_t across, std::size_t up, int channel) {
  std::vector<double> levels(image.grid.count[across] * image.grid.count[up], sigma_dbsm(0.0));
  for (std::size_t i = 0; i < image.s.size(); ++i) {
    std::array<std::size_t, 3> at{};
    for (std::size_t axis = image.axes.size(), left = i; axis-- > 0; left /= image.grid.count[axis])
      at[axis] = left % image.grid.count[axis];
    double& strongest = levels[at[up] * image.grid.count[across] + at[across]];
    strongest = std::max(strongest, level(image, i, channel));
  }
  return levels;
}

std::string heading(const std::string& title, const IsarImage& image) {
  std::string text = title + "\nISAR image; resolution";
  for (std::size_t axis = 0; axis < image.axes.size(); ++axis)
    text += fmt::format("{}{:.3g} m", axis == 0 ? " " : " × ", image.axes[axis].resolution);
  return text;
}

// Those that have anything in the range of the colours.
std::vector<int> shown_channels(const IsarImage& image, double range) {
  std::array<double, 4> peaks{};
  for (const ScatteringMatrix& s : image.s)
    for (const int channel : {0, 1, 2, 3}) {
      double& peak = peaks[static_cast<std::size_t>(channel)];
      peak = std::max(peak, std::abs(s.at(channel / 2, channel % 2)));
    }
  const double least = std::pow(10.0, -range / 20.0) * std::ranges::max(peaks);
  std::vector<int> shown;
  for (const int channel : {0, 1, 2, 3})
    if (peaks[static_cast<std::size_t>(channel)] >= least) shown.push_back(channel);
  return shown;
}

LevelPanels panels_of_plane(const std::string& title, const IsarImage& image, std::span<const std::array<dvec3, 2>> lines) {
  LevelPanels drawn{.heading = heading(title, image),
                    .x = {axis_of(image, 1), labels[1]},
                    .y = {axis_of(image, 0), labels[0]},
                    .alike = true,
                    .level_label = "σ (dBsm)",
                    .panels = {},
                    .lines = projected(lines, image.axes[1].direction, image.axes[0].direction)};
  for (const int channel : shown_channels(image, drawn.range))
    drawn.panels.push_back({channel_titles[static_cast<std::size_t>(channel)], levels_over(image, 1, 0, channel)});
  return drawn;
}

// As the radar sees it, of both co-polar channels.
LevelPanels panels_of_space(const std::string& title, const IsarImage& image, std::span<const std::array<dvec3, 2>> lines) {
  LevelPanels drawn{.heading = heading(title, image) + "; strongest cell along the line of sight",
                    .x = {axis_of(image, 1), labels[1]},
                    .y = {axis_of(image, 2), labels[2]},
                    .alike = true,
                    .level_label = "σ (dBsm)",
                    .panels = {},
                    .lines = projected(lines, image.axes[1].direction, image.axes[2].direction)};
  for (const int channel : {0, 3})
    drawn.panels.push_back({channel_titles[static_cast<std::size_t>(channel)], levels_over(image, 1, 2, channel)});
  return drawn;
}

// Red, green, blue.
std::array<double, 3> pauli_amplitudes(const ScatteringMatrix& s) {
  const double scale = std::sqrt(0.5);
  return {scale * std::abs(s.hh() - s.vv()), scale * std::abs(s.at(0, 1) + s.at(1, 0)), scale * std::abs(s.hh() + s.vv())};
}

// x, y and a colour a row.
std::string pauli_data(const IsarImage& image) {
  constexpr double range = 40.0;
  double top = std::numeric_limits<double>::min();
  for (const ScatteringMatrix& s : image.s) top = std::max(top, std::ranges::max(pauli_amplitudes(s)));
  std::string text = "$colors << EOD\n";
  for (std::size_t i = 0; i < image.s.size(); ++i) {
    text +=
        fmt::format("{:.6g} {:.6g}", image.coordinate(1, i % image.grid.count[1]), image.coordinate(0, i / image.grid.count[1]));
    for (const double amplitude : pauli_amplitudes(image.s[i]))
      text += fmt::format(" {:.0f}", 255.0 * std::clamp(1.0 + 20.0 * std::log10(amplitude / top) / range, 0.0, 1.0));
    text += '\n';
  }
  return text + "EOD\n";
}

std::string pauli_script(const std::string& file, const std::string& title, const IsarImage& image,
                         std::span<const std::array<dvec3, 2>> lines) {
  const LevelPanels axes{.heading = heading(title, image) + "\nred |HH − VV|, green |HV + VH|, blue |HH + VV|, 40 dB",
                         .x = {axis_of(image, 1), labels[1]},
                         .y = {axis_of(image, 0), labels[0]},
                         .alike = true,
                         .level_label = "",
                         .panels = {{}},
                         .lines = projected(lines, image.axes[1].direction, image.axes[0].direction)};
  return colors_panel_script(file, axes, pauli_data(image));
}

}  // namespace

std::string plot_pauli(const std::filesystem::path& folder, const std::string& title, const IsarImage& image,
                       std::span<const std::array<dvec3, 2>> target_lines) {
  const std::filesystem::path picture = folder / "isar_pauli.png";
  return draw_picture(picture, pauli_script(picture.string(), title, image, target_lines));
}

std::string plot_isar(const std::filesystem::path& folder, const std::string& title, const IsarImage& image,
                      std::span<const std::array<dvec3, 2>> target_lines) {
  const LevelPanels drawn =
      image.axes.size() == 2 ? panels_of_plane(title, image, target_lines) : panels_of_space(title, image, target_lines);
  return draw_picture(folder / "isar.png", level_panels_script("pngcairo", (folder / "isar.png").string(), drawn));
}

}  // namespace raytube
