// raytube compare: two results or images -> error measures, table and picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.h"
#include "output/compare/comparison.h"
#include "output/compare/comparison_report.h"
#include "output/tables/column_map.h"
#include "output/tables/image_file.h"
#include "program/commands.h"
#include "program/python.h"
#include "program/selection.h"
#include "program/work/destination.h"
#include "program/work/exit_codes.h"
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

void write_files(const Request& request, const Comparison& comparison) {
  const OutputFolder folder(request.output_folder);
  AllOrNothing ending(folder);
  const InterruptFlag interrupt_flag([&ending] { return ending.last_words(); });
  NewResults results(folder.path());
  write_compare_csv(results.folder() / "compare.csv", comparison, {request.result_columns, request.reference_columns});
  const std::string trouble = draw_with_python(results.folder(), {"compare.csv"}, {});
  stop_if_interrupted();
  if (!trouble.empty()) warn(trouble);
  replace_results(results, folder.path(), comparison_results, {}, [&ending] { ending.complete(); });
  if (!request.json)
    fmt::print("results in {}: compare.csv{}\n", folder.path().string(), trouble.empty() ? ", compare.png, compare.svg" : "");
}

// What exceeds a tolerance, in words; empty if nothing does.
std::string shortfall(const Comparison& c, const Request& request) {
  const std::size_t smaller = std::min(c.result.rows.size(), c.reference.rows.size());
  const std::size_t least = request.min_matched.value_or(smaller);
  if (c.rows() < least) return fmt::format("{} of {} rows have a partner, fewer than the {} required", c.rows(), smaller, least);
  if (request.tolerance_db)
    if (const std::string above = above_tolerance(c, *request.tolerance_db); !above.empty())
      return fmt::format("rms error above the tolerance of {:g} dB: {}", *request.tolerance_db, above);
  if (!request.tolerance_relative) return "";
  const double relative = relative_error(c);
  if (std::isinf(relative)) return "no relative error: one of the tables has rows or channels of its own, or no phase";
  if (relative <= *request.tolerance_relative) return "";
  return fmt::format("relative error {:.2g} of complex S above the tolerance of {:g}", relative, *request.tolerance_relative);
}

// A line for people, and the exit code for scripts, where a tolerance was asked for.
void judge(const Comparison& comparison, const Request& request) {
  if (!request.tolerance_db && !request.tolerance_relative && !request.min_matched) return;
  const std::string above = shortfall(comparison, request);
  if (!request.json) fmt::print("{}\n", above.empty() ? "PASS" : "FAIL");
  if (!above.empty()) throw AboveTolerance(above);
}

}  // namespace

bool compares_images(const Request& request) {
  return is_image_file(result_in(request.result), parsed_column_map("--result-columns", request.result_columns)) ||
         is_image_file(result_in(request.reference), parsed_column_map("--reference-columns", request.reference_columns));
}

void compare_command(const Request& asked) {
  Request request = asked;
  for (std::filesystem::path* file : {&request.result, &request.reference}) *file = result_in(*file);
  if (!request.output_folder.empty())
    check_output(request.output_folder, comparison_results,
                 {{"the first table", request.result}, {"the second table", request.reference}});
  if (request.no_register) throw InputError("--no-register: only images are registered; leave the option out");
  const auto table = [](const std::filesystem::path& file, const std::string& option, const std::string& columns) {
    return read_result_table(file, parsed_column_map(option, columns), option);
  };
  ResultTable result = table(request.result, "--result-columns", request.result_columns);
  ResultTable reference = table(request.reference, "--reference-columns", request.reference_columns);
  keep_chosen_rows(result, reference, request.only);
  const Comparison comparison = compare_results(std::move(result), std::move(reference), request.within_db, request.free_scale);
  fmt::print("{}", request.json ? comparison_json(comparison) + '\n' : comparison_text(comparison));
  if (!request.output_folder.empty()) write_files(request, comparison);
  judge(comparison, request);
}

}  // namespace raytube
