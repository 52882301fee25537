// The commands that draw and describe results which are there: what they are asked for, and their part of the command line.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace raytube {

struct PlotRequest {
  std::vector<std::filesystem::path> results;
  std::filesystem::path output;  // a picture or a folder; empty: the folder of the first result
  std::string kind = "auto", channels, unit = "dbsm", size, style = "screen", title;
  std::optional<double> range_db;
  bool quiet = false;
};

struct StatisticsRequest {
  std::filesystem::path result;
  std::filesystem::path output_folder;  // empty: no files
  std::optional<double> window_deg;
  std::string percentiles = "10,50,90";
  std::vector<std::string> only;  // COLUMN=LOW:HIGH
};

CLI::App* add_plot(CLI::App& app, PlotRequest& request);
CLI::App* add_statistics(CLI::App& app, StatisticsRequest& request);

// Each throws InputError for bad input.
void plot_command(const PlotRequest& request);
void statistics_command(const StatisticsRequest& request);

}  // namespace raytube
