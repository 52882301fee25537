// A picture before it is drawn, and the canvas it is drawn on.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "output/charts/chart_data.h"

namespace raytube {

/// A picture before it is drawn.
struct Chart {
  std::array<double, 2> design;            // width and height for which the commands are made [pixels]
  std::optional<std::array<int, 2>> size;  // those asked for
  std::string commands;                    // of gnuplot, without terminal and file
};

/// The gnuplot commands and data that draw `file`, whose ending is .png, .svg or .pdf. Text and lines grow with the picture.
std::string chart_script(const Chart& chart, const std::filesystem::path& file);

/// Width and height in which a picture made for `wanted` is laid out: of the form asked for, and of the same area.
std::array<double, 2> laid_out(std::array<double, 2> wanted, const ChartOptions& options);

}  // namespace raytube
