// raytube compare: two results or images -> error measures, table and picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.h"
#include "output/compare/comparison.h"
#include "output/compare/comparison_report.h"
#include "output/image_compare/image_report.h"
#include "output/image_compare/read_image.h"
#include "output/imaging/image_comparison_plot.h"
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

template <class Compared>
void write_files(const std::filesystem::path& destination, const Compared& comparison, const char* pictures) {
  const OutputFolder folder(destination);
  AllOrNothing ending(folder);
  const InterruptFlag interrupt_flag([&ending] { return ending.last_words(); });
  NewResults results(folder.path());
  write_compare_csv(results.folder() / "compare.csv", comparison);
  const std::string trouble = plot_comparison(results.folder(), comparison);
  stop_if_interrupted();
  if (!trouble.empty()) warn(trouble);
  replace_results(results, folder.path(), comparison_results, {}, [&ending] { ending.complete(); });
  fmt::print("results in {}: compare.csv{}\n", folder.path().string(), trouble.empty() ? pictures : "");
}

// Throws what makes the program end with 1.
template <class Compared>
void fall_short_above(const Compared& comparison, const Request& request) {
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

template <class Compared>
void tell(const Compared& comparison, const Request& request, const char* pictures) {
  fmt::print("{}", comparison_text(comparison));
  if (!request.output_folder.empty()) write_files(request.output_folder, comparison, pictures);
  fall_short_above(comparison, request);
}

void compare_tables(const Request& request, const NamedFile& a, const NamedFile& b) {
  if (request.no_register) throw InputError("--no-register: only images are registered; leave the option out");
  ResultTable result = read_result_table(a.file, a.map, a.option), reference = read_result_table(b.file, b.map, b.option);
  keep_chosen_rows(result, reference, request.only);
  tell(compare_results(std::move(result), std::move(reference), request.within_db, request.free_scale), request,
       ", compare.png, compare.svg");
}

void compare_both_images(const Request& request, const NamedFile& a, const NamedFile& b) {
  if (!request.only.empty())
    throw InputError(fmt::format("--only {}: images have no rows of looks; leave the option out", request.only.front()));
  tell(compare_images(read_image(a), read_image(b), {request.within_db, request.free_scale, !request.no_register}), request,
       ", compare.png");
}

NamedFile named_file(const std::filesystem::path& file, const std::string& option, const std::string& columns) {
  return {file, parsed_column_map(option, columns), option};
}

}  // namespace

void compare_command(const Request& request) {
  if (!request.output_folder.empty())
    check_output(request.output_folder, comparison_results,
                 {{"the first table", request.result}, {"the second table", request.reference}});
  const NamedFile result = named_file(request.result, "--result-columns", request.result_columns),
                  reference = named_file(request.reference, "--reference-columns", request.reference_columns);
  are_images(result, reference) ? compare_both_images(request, result, reference) : compare_tables(request, result, reference);
}

}  // namespace raytube
