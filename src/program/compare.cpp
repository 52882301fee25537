// raytube compare: two results -> error measures, table and picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.h"
#include "output/compare/comparison.h"
#include "output/compare/comparison_report.h"
#include "output/plots/comparison_plot.h"
#include "program/commands.h"
#include "program/selection.h"
#include "program/work/interrupt.h"
#include "program/work/results.h"

namespace raytube {

namespace {

void keep_chosen_rows(ResultTable& result, ResultTable& reference, const std::vector<std::string>& options) {
  for (const std::string& option : options) {
    const auto [key, low, high] = parsed_only(option);
    if (!result.has_key[key] && !reference.has_key[key])
      throw InputError(fmt::format("--only {}: neither {} nor {} has that column; leave the option out", option,
                                   result.file.string(), reference.file.string()));
    keep_rows(result, key, low, high);
    keep_rows(reference, key, low, high);
  }
}

const ResultNames comparison_results = {{"compare.png", "compare.svg"}, {"compare.csv"}};

void write_files(const std::filesystem::path& destination, const Comparison& comparison) {
  const OutputFolder folder(destination);
  AllOrNothing ending(folder);
  const InterruptFlag interrupt_flag([&ending] { return ending.last_words(); });
  NewResults results(folder.path());
  write_compare_csv(results.folder() / "compare.csv", comparison);
  const std::string trouble = plot_comparison(results.folder(), comparison);
  stop_if_interrupted();
  if (!trouble.empty()) warn(trouble);
  replace_results(results, folder.path(), comparison_results, {}, [&ending] { ending.complete(); });
  fmt::print("results in {}: compare.csv{}\n", folder.path().string(), trouble.empty() ? ", compare.png, compare.svg" : "");
}

// Throws what makes the program end with 1.
void fall_short_above(const Comparison& comparison, const Request& request) {
  if (request.tolerance_db)
    if (const std::string above = above_tolerance(comparison, *request.tolerance_db); !above.empty())
      throw std::runtime_error(fmt::format("rms error above the tolerance of {:g} dB: {}", *request.tolerance_db, above));
  if (!request.tolerance_relative) return;
  const double relative = relative_error(comparison);
  if (std::isinf(relative))
    throw std::runtime_error("no relative error: one of the tables has rows or channels of its own, or no phase");
  if (!(relative <= *request.tolerance_relative))
    throw std::runtime_error(
        fmt::format("relative error {:.2g} of complex S above the tolerance of {:g}", relative, *request.tolerance_relative));
}

}  // namespace

void compare_command(const Request& request) {
  if (!request.output_folder.empty())
    check_output(request.output_folder, comparison_results,
                 {{"the first table", request.result}, {"the second table", request.reference}});
  const ColumnMap result_columns = parsed_column_map("--result-columns", request.result_columns),
                  reference_columns = parsed_column_map("--reference-columns", request.reference_columns);
  ResultTable result = read_result_table(request.result, result_columns, "--result-columns"),
              reference = read_result_table(request.reference, reference_columns, "--reference-columns");
  keep_chosen_rows(result, reference, request.only);
  const Comparison comparison = compare_results(std::move(result), std::move(reference), request.within_db, request.free_scale);
  fmt::print("{}", comparison_text(comparison));
  if (!request.output_folder.empty()) write_files(request.output_folder, comparison);
  fall_short_above(comparison, request);
}

}  // namespace raytube
