// What `raytube plot` is asked for, and the results it draws.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "output/tables/cuts.h"
#include "output/tables/result_table.h"

namespace raytube {

enum class ChartKind { automatic, curves, map, polar };
enum class ChartUnit { dbsm, square_metres, db_of_peak };

struct ChartOptions {
  ChartKind kind = ChartKind::automatic;
  std::vector<std::size_t> channels{};  // empty: those with a signal
  std::optional<double> range_db{};     // below the peak
  ChartUnit unit = ChartUnit::dbsm;
  std::optional<std::array<int, 2>> size{};  // width and height [pixels]
  bool print = false;                        // black and grey, told apart by dashes and symbols
  std::string title{};                       // empty: the names of the results
};

/// One of the results of a picture.
struct ChartResult {
  std::filesystem::path file;
  std::string name;  // short, and unlike that of any other
  RowCoordinates coordinates;
  CutPlan plan;
  std::array<bool, 4> has_channel{};
  std::array<std::vector<double>, 4> sigma_dbsm;  // [channel][row]; -inf where there is none
  std::size_t peak_row = 0;                       // of the largest sigma in the channels drawn

  double peak_dbsm(std::span<const std::size_t> channels) const;
};

/// Results as pictures need them, under names that tell them apart: what their paths do not share.
std::vector<ChartResult> chart_results(const std::vector<ResultTable>& tables);

/// The channels to draw: those asked for, otherwise those that every result has and that come within 80 dB of the peak; of
/// several results the co-polar ones alone if they have these. Sets each result's peak_row. Throws InputError if a result lacks
/// one.
std::vector<std::size_t> chosen_channels(std::vector<ChartResult>& results, const std::vector<std::size_t>& asked);

}  // namespace raytube
