#include "output/charts/chart_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "output/tables/csv.h"
#include "output/tables/key_coordinates.h"

namespace raytube {

namespace {

constexpr double signal_range_db = 80.0;  // as of rcs.png
constexpr double nothing = -std::numeric_limits<double>::infinity();

using Names = std::vector<std::vector<std::string>>;

std::vector<std::string> pieces_of(const std::filesystem::path& file) {
  const std::filesystem::path path = std::filesystem::absolute(file).lexically_normal();
  std::vector<std::string> pieces;
  for (const auto& piece : path.parent_path()) pieces.push_back(piece.string());
  pieces.push_back(path.stem().string());
  return pieces;
}

bool share_last(const Names& names) {
  return std::ranges::all_of(names,
                             [&](const auto& pieces) { return pieces.size() > 1 && pieces.back() == names.front().back(); });
}

// From the last piece in which they are not all alike, to the left until all are different.
std::vector<std::string> short_names(const std::vector<ResultTable>& tables) {
  Names names;
  for (const ResultTable& table : tables) names.push_back(pieces_of(table.file));
  while (tables.size() > 1 && share_last(names))
    for (auto& pieces : names) pieces.pop_back();
  std::vector<std::string> told(names.size());
  for (std::size_t depth = 0; depth < 64; ++depth) {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (depth < names[i].size()) told[i] = names[i][names[i].size() - 1 - depth] + (told[i].empty() ? "" : "/") + told[i];
    std::vector<std::string> sorted = told;
    std::ranges::sort(sorted);
    if (std::ranges::adjacent_find(sorted) == sorted.end()) return told;
  }
  for (std::size_t i = 0; i < told.size(); ++i) told[i] = fmt::format("{} ({})", names[i].back(), i + 1);  // one file twice
  return told;
}

ChartResult chart_result(const ResultTable& table, std::string name) {
  std::vector<ResultTable::Keys> keys;
  ChartResult result{table.file, std::move(name), {}, {}, table.has_channel, {}};
  for (const ResultTable::Row& row : table.rows) {
    keys.push_back(row.key);
    for (std::size_t c = 0; c < 4; ++c) result.sigma_dbsm[c].push_back(table.has_channel[c] ? row.sigma_dbsm[c] : nothing);
  }
  result.coordinates = coordinates_of_keys(keys, table.has_key);
  result.plan = plan_cuts(result.coordinates);
  return result;
}

std::vector<std::size_t> held_by_all(const std::vector<ChartResult>& results) {
  std::vector<std::size_t> channels;
  for (std::size_t c = 0; c < 4; ++c)
    if (std::ranges::all_of(results, [c](const ChartResult& result) { return result.has_channel[c]; })) channels.push_back(c);
  if (channels.empty()) throw InputError("the results have no channel in common; plot them one by one");
  return channels;
}

std::vector<std::size_t> with_signal(const std::vector<ChartResult>& results, const std::vector<std::size_t>& channels) {
  double peak = nothing;
  std::array<double, 4> peaks{};
  for (const std::size_t c : channels) {
    peaks[c] = nothing;
    for (const ChartResult& result : results) peaks[c] = std::max(peaks[c], result.peak_dbsm({&c, 1}));
    peak = std::max(peak, peaks[c]);
  }
  std::vector<std::size_t> kept;
  for (const std::size_t c : channels)
    if (peaks[c] >= peak - signal_range_db) kept.push_back(c);
  return kept;
}

std::vector<std::size_t> default_channels(const std::vector<ChartResult>& results) {
  std::vector<std::size_t> channels = with_signal(results, held_by_all(results));
  const bool co_polar = std::ranges::any_of(channels, [](std::size_t c) { return c == 0 || c == 3; });
  if (results.size() > 1 && co_polar) std::erase_if(channels, [](std::size_t c) { return c == 1 || c == 2; });
  return channels;
}

std::size_t row_of_peak(const ChartResult& result, const std::vector<std::size_t>& channels) {
  std::size_t best = 0;
  double highest = nothing;
  for (std::size_t row = 0; row < result.coordinates.rows.size(); ++row)
    for (const std::size_t c : channels)
      if (result.sigma_dbsm[c][row] > highest) highest = result.sigma_dbsm[c][row], best = row;
  return best;
}

}  // namespace

double ChartResult::peak_dbsm(std::span<const std::size_t> channels) const {
  double peak = nothing;
  for (const std::size_t c : channels)
    if (!sigma_dbsm[c].empty()) peak = std::max(peak, std::ranges::max(sigma_dbsm[c]));
  return peak;
}

std::vector<ChartResult> chart_results(const std::vector<ResultTable>& tables) {
  const std::vector<std::string> names = short_names(tables);
  std::vector<ChartResult> results;
  for (std::size_t i = 0; i < tables.size(); ++i) results.push_back(chart_result(tables[i], names[i]));
  return results;
}

std::vector<std::size_t> chosen_channels(std::vector<ChartResult>& results, const std::vector<std::size_t>& asked) {
  for (const ChartResult& result : results)
    for (const std::size_t c : asked)
      if (!result.has_channel[c])
        throw InputError(
            fmt::format("--channels {}: {} has no such channel; leave it out", channel_names[c], result.file.string()));
  const std::vector<std::size_t> channels = asked.empty() ? default_channels(results) : asked;
  for (ChartResult& result : results) result.peak_row = row_of_peak(result, channels);
  return channels;
}

}  // namespace raytube
