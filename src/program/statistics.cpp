// raytube statistics: a result -> how its sigma is distributed.
#include <fmt/format.h>

#include <algorithm>

#include "core/csv_reader.h"
#include "core/error.h"
#include "core/text.h"
#include "output/statistics/statistics_plot.h"
#include "program/result_commands.h"
#include "program/selection.h"
#include "program/work/interrupt.h"
#include "program/work/results.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

const ResultNames statistics_results = {{"statistics.png", "statistics.svg"}, {"statistics.csv", "fits.csv", "histogram.csv"}};

std::vector<double> percentiles_of(const std::string& text) {
  std::vector<double> percentiles;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::optional<double> percent = parsed_number(text.substr(begin, end - begin));
    if (!percent || !(*percent >= 0.0) || !(*percent <= 100.0) || (!percentiles.empty() && !(*percent > percentiles.back())))
      throw InputError(
          fmt::format("--percentiles {}: write ascending numbers from 0 to 100, for example 10,50,90", quotable(text)));
    percentiles.push_back(*percent);
    begin = end + 1;
  }
  return percentiles;
}

void keep_selected_rows(ResultTable& table, const std::vector<std::string>& options) {
  for (const std::string& option : options) {
    const auto [key, low, high] = parsed_only(option);
    if (!table.has_key[key])
      throw InputError(fmt::format("--only {}: {} has no such column; leave the option out", option, table.file.string()));
    keep_rows(table, key, low, high);
  }
}

void write_statistics(const fs::path& destination, const SigmaStatistics& statistics) {
  const OutputFolder folder(destination);
  AllOrNothing ending(folder);
  const InterruptFlag interrupt_flag([&ending] { return ending.last_words(); });
  NewResults results(folder.path());
  write_statistics_csv(results.folder() / "statistics.csv", statistics);
  write_fits_csv(results.folder() / "fits.csv", statistics);
  write_histogram_csv(results.folder() / "histogram.csv", statistics);
  const std::string trouble = plot_statistics(results.folder(), statistics);
  stop_if_interrupted();
  if (!trouble.empty()) warn(trouble);
  replace_results(results, folder.path(), statistics_results, {}, [&ending] { ending.complete(); });
  fmt::print("results in {}: statistics.csv, fits.csv, histogram.csv{}\n", folder.path().string(),
             trouble.empty() ? ", statistics.png, statistics.svg" : "");
}

}  // namespace

void statistics_command(const StatisticsRequest& request) {
  const std::vector<double> percentiles = percentiles_of(request.percentiles);
  if (!request.output_folder.empty()) check_output(request.output_folder, statistics_results, {{"the result", request.result}});
  if (request.window_deg && request.output_folder.empty())
    throw InputError("--window: what the windows hold is written, not printed; name a folder with -o DIR");
  ResultTable table = read_result_table(request.result);
  keep_selected_rows(table, request.only);
  const SigmaStatistics statistics = sigma_statistics(table, percentiles, request.window_deg);
  fmt::print("{}", statistics_text(statistics));
  if (!request.output_folder.empty()) write_statistics(request.output_folder, statistics);
}

}  // namespace raytube
