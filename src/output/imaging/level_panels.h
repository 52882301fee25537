// Levels over two even axes as colours, several panels under one heading.
#pragma once

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/field.h"
#include "imaging/sweep_grid.h"

namespace raytube {

/// An axis of a panel: its values and how it is called.
struct PanelAxis {
  EvenAxis values;
  std::string label;
};

struct LevelPanel {
  std::string title;
  std::vector<double> levels;  // [y][x] [dB]
};

/// Panels side by side with the same axes and colours.
struct LevelPanels {
  std::string heading;  // lines of it under one another
  PanelAxis x, y;
  bool alike = false;  // a metre is as long along both
  std::string level_label;
  double range = 50.0;  // [dB] below the strongest that colours reach
  std::vector<LevelPanel> panels;
  std::vector<std::array<dvec2, 2>> lines{};  // drawn over each
  std::size_t in_a_row = 2;
};

/// Lines in space on the plane of two axes.
std::vector<std::array<dvec2, 2>> projected(std::span<const std::array<dvec3, 2>> lines, const dvec3& across, const dvec3& up);

/// The data block $lines; empty without lines.
std::string lines_data(const std::vector<std::array<dvec2, 2>>& lines);

/// The gnuplot commands and data that draw `file`; what has more values than dots shows the strongest of each dot's.
std::string level_panels_script(const std::string& terminal, const std::string& file, const LevelPanels& drawn);

/// One panel with these axes, heading and lines, of colours: rows of x, y, red, green and blue (0 to 255) in the data block
/// $colors.
std::string colors_panel_script(const std::string& file, const LevelPanels& axes, const std::string& colors);

}  // namespace raytube
