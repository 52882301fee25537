#include "output/charts/chart.h"

#include <fmt/format.h>

#include "core/error.h"
#include "output/charts/chart_style.h"
#include "output/charts/curve_chart.h"
#include "output/charts/map_chart.h"
#include "output/charts/polar_chart.h"

namespace raytube {

namespace {

constexpr std::size_t most_panels = 4;

void require_few(const std::vector<ChartResult>& results) {
  if (results.size() > most_results)
    throw InputError(
        fmt::format("{} results: more than {} in one picture cannot be told apart; plot fewer", results.size(), most_results));
}

std::string title_of(const std::vector<ChartResult>& results) {
  if (results.size() == 1) return results.front().file.string();
  std::string text;
  for (const ChartResult& result : results) text += (text.empty() ? "" : ", ") + result.name;
  return text;
}

Chart map_of(const ChartResult& result, const SweepMap& map, const std::vector<std::size_t>& channels,
             const ChartOptions& options) {
  return map_chart(result, map, options.channels.empty() ? channels_with_maps(result, channels) : channels, options);
}

Chart automatic_chart(const std::vector<ChartResult>& results, const std::vector<std::size_t>& channels,
                      const ChartOptions& options) {
  if (results.size() == 1)
    if (const auto map = chart_map(results.front(), most_panels)) return map_of(results.front(), *map, channels, options);
  return curve_chart(results, channels, options);
}

Chart map_on_request(const std::vector<ChartResult>& results, const std::vector<std::size_t>& channels,
                     const ChartOptions& options) {
  if (results.size() > 1) throw InputError(fmt::format("--kind map: {} results; a map shows one, give one file", results.size()));
  const ChartResult& result = results.front();
  const auto map = chart_map(result, 1);
  if (map) return map_of(result, *map, channels, options);
  throw InputError(fmt::format("--kind map: {} holds no grid over two quantities; use --kind curves", result.file.string()));
}

}  // namespace

Chart made_chart(std::vector<ChartResult> results, const ChartOptions& asked) {
  require_few(results);
  const std::vector<std::size_t> channels = chosen_channels(results, asked.channels);
  ChartOptions options = asked;
  if (options.title.empty()) options.title = title_of(results);
  switch (options.kind) {
    case ChartKind::curves:
      return curve_chart(results, channels, options);
    case ChartKind::map:
      return map_on_request(results, channels, options);
    case ChartKind::polar:
      return polar_chart(results, channels, options);
    default:
      return automatic_chart(results, channels, options);
  }
}

}  // namespace raytube
