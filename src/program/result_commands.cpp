#include "program/result_commands.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "core/csv_reader.h"

namespace raytube {

namespace {

constexpr const char* plot_examples =
    "A result is rcs.csv, a netCDF file (.nc) of raytube's, or any table that compare takes. Sweeps over two quantities are "
    "maps, the\n"
    "whole sphere in a projection of equal areas; several results are curves in one picture. A result of a single look is "
    "printed\n"
    "as a table. Writes plot.png and plot.svg beside the first result, or what -o names.\n\n"
    "Examples:\n"
    "  raytube plot out/rcs.csv\n"
    "  raytube plot a/rcs.csv b/rcs.csv -o both.pdf --channels vv --style print\n"
    "  raytube plot out/rcs.nc -o polar.png --kind polar --range 40 --size 1600x1400\n"
    "  raytube plot out/rcs.csv -o map.svg --unit db-peak --title \"Cube at 10 GHz\"";

constexpr const char* statistics_examples =
    "A result is rcs.csv, a netCDF file (.nc) of raytube's, or any table that compare takes; each row counts once. Prints mean,\n"
    "median, percentiles and standard deviation of sigma for each channel, and how well Swerling I and III, chi-square and\n"
    "log-normal laws fit. With -o it also writes statistics.csv (with --window of sliding sectors, too), fits.csv, "
    "histogram.csv,\n"
    "statistics.png and statistics.svg.\n\n"
    "Examples:\n"
    "  raytube statistics out/rcs.csv\n"
    "  raytube statistics out/rcs.csv --window 10 --percentiles 5,50,95 -o statistics\n"
    "  raytube statistics out/rcs.nc --only theta_deg=90 --only phi_deg=-45:45";

std::string not_a_range(const std::string& text) {
  const std::optional<double> number = parsed_number(text);
  return number && std::isfinite(*number) && *number > 0.0 && *number <= 300.0
             ? ""
             : "needs a number of decibels above 0, at most 300 (found " + text + ")";
}

std::string not_a_window(const std::string& text) {
  const std::optional<double> number = parsed_number(text);
  return number && *number > 0.0 && *number <= 360.0 ? "" : "needs a width in degrees above 0, at most 360 (found " + text + ")";
}

std::string not_a_place(const std::string& name) { return name.empty() ? "needs the name of a picture or a folder" : ""; }

std::string not_a_folder(const std::string& name) { return name.empty() ? "needs the name of a folder" : ""; }

}  // namespace

CLI::App* add_plot(CLI::App& app, PlotRequest& request) {
  CLI::App* plot = app.add_subcommand("plot", "Draw results as curves, maps or polar curves");
  plot->footer(plot_examples);
  plot->add_option("result", request.results, "Tables or netCDF files of results")->required()->type_name("A.csv|A.nc...");
  plot->add_option("-o,--output", request.output,
                   "Picture, or folder for plot.png and plot.svg; default the first result's folder")
      ->type_name("FILE.png|FILE.svg|FILE.pdf|DIR")
      ->check(not_a_place);
  plot->add_option("--kind", request.kind, "auto: maps of sweeps over two quantities, otherwise curves; default auto")
      ->type_name("auto|curves|map|polar");
  plot->add_option("--channels", request.channels, "Channels to draw: vv,vh,hv,hh; default those with a signal")
      ->type_name("PQ,...");
  plot->add_option("--range", request.range_db,
                   "Show so much below the peak; default down to the lowest rows, maps 50 dB at most")
      ->type_name("DB")
      ->check(not_a_range);
  plot->add_option("--unit", request.unit, "dBsm, square metres, or dB below the peak; default dbsm")
      ->type_name("dbsm|m2|db-peak");
  plot->add_option("--size", request.size, "Pixels; of a PDF hundredths of an inch. Text grows with it")
      ->type_name("WIDTHxHEIGHT");
  plot->add_option("--style", request.style, "Colours, or black and grey; default screen")->type_name("screen|print");
  plot->add_option("--title", request.title, "Heading; default the results' names")->type_name("TEXT");
  plot->add_flag("--quiet", request.quiet, "Do not say what was written");
  return plot;
}

CLI::App* add_statistics(CLI::App& app, StatisticsRequest& request) {
  CLI::App* statistics = app.add_subcommand("statistics", "Mean, percentiles and distribution of sigma");
  statistics->footer(statistics_examples);
  statistics->add_option("result", request.result, "Table or netCDF file of a result")->required()->type_name("A.csv|A.nc");
  statistics->add_option("-o,--output", request.output_folder, "Folder for the tables and the picture; default none")
      ->type_name("DIR")
      ->check(not_a_folder);
  statistics->add_option("--window", request.window_deg, "Also of windows of this width that slide along the swept angle")
      ->type_name("DEG")
      ->check(not_a_window);
  statistics->add_option("--percentiles", request.percentiles, "Shares of the rows that lie below; default 10,50,90")
      ->type_name("N,N,...");
  statistics->add_option("--only", request.only, "Only rows with this: COLUMN=VALUE or COLUMN=LOW:HIGH; may be repeated")
      ->type_name("COLUMN=LOW:HIGH")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return statistics;
}

}  // namespace raytube
