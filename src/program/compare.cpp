// raytube compare: two results or images -> error measures, table and picture.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "core/csv_reader.h"
#include "core/error.h"
#include "output/compare/comparison.h"
#include "output/compare/comparison_report.h"
#include "output/tables/column_map.h"
#include "output/tables/image_file.h"
#include "program/options.h"
#include "program/python.h"
#include "program/work/destination.h"
#include "program/work/exit_codes.h"
#include "program/work/results.h"

namespace raytube {

namespace {

constexpr const char* compare_examples =
    R"(A and B are tables with a header: rcs.csv, channels.csv, or any file with freq_hz, theta_deg, phi_deg[, rx_theta_deg,
rx_phi_deg] and, for each channel pq = vv, vh, hv, hh, re_pq and im_pq [m], magnitude_pq (root of sigma) and phase_pq_rad, or
sigma_pq_dbsm. Rows with equal frequency and angles are compared.
A netCDF file (.nc) by raytube serves as a table, too.
Images are compared with images, after one is shifted onto the other: image.csv, the results of raytube isar, a table with a row
for each pixel (col and row, or u_m and v_m) and channels as above, or OpenEXR, whose channels are its columns.
With -o it also writes compare.csv, compare.png and, for tables, compare.svg.

Examples:
  raytube compare out/rcs.csv reference.csv
  raytube compare render.exr out/image.csv --result-columns magnitude_vv=VV.mag --free-scale -o comparison
  raytube compare out/rcs.csv reference.csv -o comparison --tolerance-db 0.5
  raytube compare a.csv b.csv --only phi_deg=-45:45 --within-db 40
  raytube compare out/rcs.csv renderer.csv --reference-columns "freq_hz=f*1e9,theta_deg=el*-1+90,phi_deg=az")";

struct CompareRequest {
  std::filesystem::path result, reference;
  std::filesystem::path output;                   // empty: no files
  std::string result_columns, reference_columns;  // OURS=THEIRS,...
  std::vector<std::string> only;                  // COLUMN=LOW:HIGH
  double within_db = 20.0;                        // of the reference's peak: rows that count
  std::optional<double> tolerance_db;
  std::optional<double> tolerance_relative;
  std::optional<std::size_t> min_matched;  // none: all rows of the smaller table
  bool free_scale = false;                 // fit one factor first
  bool no_register = false;
  bool json = false;
};

// Keeps the rows that --only asks for.
void keep_rows_with(ResultTable& result, ResultTable& reference, const std::string& option) {
  const std::size_t equals = option.find('=');
  const std::string column = option.substr(0, equals), range = equals == std::string::npos ? "" : option.substr(equals + 1);
  const std::size_t colon = range.find(':');
  const auto low = parsed_number(range.substr(0, colon));
  const auto high = colon == std::string::npos ? low : parsed_number(range.substr(colon + 1));
  const auto found = std::ranges::find(key_names, column);
  if (found == key_names.end() || !low || !high || !(*low <= *high))
    throw InputError(
        fmt::format("--only {}: write COLUMN=VALUE or COLUMN=LOW:HIGH with freq_hz, theta_deg, phi_deg, rx_theta_deg, "
                    "rx_phi_deg or time_s, for example --only phi_deg=-45:45",
                    option));
  const auto key = static_cast<ResultTable::Key>(found - key_names.begin());
  if (!result.has_key[key] && !reference.has_key[key])
    throw InputError(fmt::format("--only {}: neither {} nor {} has that column; leave the option out", option,
                                 result.file.string(), reference.file.string()));
  keep_rows(result, key, *low, *high);
  keep_rows(reference, key, *low, *high);
}

const ResultNames comparison_results = {{"compare.png", "compare.svg"}, {"compare.csv"}};

void write_comparison(const CompareRequest& asked, const Comparison& comparison) {
  AllOrNothing results(asked.output);
  const auto write = [&](const std::filesystem::path& folder) {
    write_compare_csv(folder / "compare.csv", comparison, {asked.result_columns, asked.reference_columns});
    draw_with_python(folder, {"compare.csv"});
  };
  const std::vector<std::string> placed = results.place(comparison_results, write);
  if (!asked.json) fmt::print("results in {}: {}\n", results.folder().string(), fmt::join(placed, ", "));
}

// The sentence about an exceeded tolerance; empty if none is exceeded.
std::string shortfall(const Comparison& c, const CompareRequest& asked) {
  const std::size_t smaller = std::min(c.result.rows.size(), c.reference.rows.size());
  const std::size_t least = asked.min_matched.value_or(smaller);
  if (c.rows() < least) return fmt::format("{} of {} rows have a partner, fewer than the {} required", c.rows(), smaller, least);
  if (asked.tolerance_db)
    if (const std::string above = above_tolerance(c, *asked.tolerance_db); !above.empty())
      return fmt::format("rms error above the tolerance of {:g} dB: {}", *asked.tolerance_db, above);
  if (!asked.tolerance_relative) return "";
  const double relative = relative_error(c);
  if (std::isinf(relative)) return "no relative error: one of the tables has rows or channels of its own, or no phase";
  if (relative <= *asked.tolerance_relative) return "";
  return fmt::format("relative error {:.2g} of complex S above the tolerance of {:g}", relative, *asked.tolerance_relative);
}

// Where a tolerance was given: prints a line for people, and sets the exit code for scripts.
void judge(const Comparison& comparison, const CompareRequest& asked) {
  if (!asked.tolerance_db && !asked.tolerance_relative && !asked.min_matched) return;
  const std::string above = shortfall(comparison, asked);
  if (!asked.json) fmt::print("{}\n", above.empty() ? "PASS" : "FAIL");
  if (!above.empty()) throw AboveTolerance(above);
}

void compare_tables(const CompareRequest& asked) {
  if (!asked.output.empty())
    check_output(asked.output, comparison_results, {{"the first table", asked.result}, {"the second table", asked.reference}});
  if (asked.no_register) throw InputError("--no-register: only images are registered; leave the option out");
  const auto table = [](const std::filesystem::path& file, const std::string& option, const std::string& columns) {
    return read_result_table(file, parsed_column_map(option, columns), option);
  };
  ResultTable result = table(asked.result, "--result-columns", asked.result_columns);
  ResultTable reference = table(asked.reference, "--reference-columns", asked.reference_columns);
  for (const std::string& option : asked.only) keep_rows_with(result, reference, option);
  const Comparison comparison = compare_results(std::move(result), std::move(reference), asked.within_db, asked.free_scale);
  fmt::print("{}", asked.json ? comparison_json(comparison) + '\n' : comparison_text(comparison));
  if (!asked.output.empty()) write_comparison(asked, comparison);
  judge(comparison, asked);
}

// A check for CLI11: a number that is 0 or more. `needs` is the sentence for other texts.
OptionCheck not_negative(const char* needs) {
  return [needs](const std::string& text) {
    const std::optional<double> number = parsed_number(text);
    return number && std::isfinite(*number) && *number >= 0.0 ? "" : fmt::format("needs {} (found {})", needs, text);
  };
}

}  // namespace

CLI::App& add_compare(CommandLine& line) {
  const auto asked = std::make_shared<CompareRequest>();
  const OptionCheck decibels = not_negative("a number of decibels, 0 or more");
  CLI::App& compare = add_command(line, "compare", "Measure how far a result is from a reference", compare_examples);
  add_value(compare, "result A.csv|A.nc|A.exr", asked->result, "Table or image to be judged")->required();
  add_value(compare, "reference B.csv|B.nc|B.exr", asked->reference, "Table or image to judge it by")->required();
  add_output_option(compare, asked->output, "Folder for compare.csv and the picture; default none");
  add_value(compare, "--tolerance-db X", asked->tolerance_db, "Exit with 1 (FAIL) if the rms error of a channel exceeds this",
            decibels);
  add_value(compare, "--tolerance-relative X", asked->tolerance_relative,
            "Exit with 1 if ||A - B|| / ||B|| of complex S, over all rows and channels, exceeds this, or if one table has "
            "rows or channels of its own",
            not_negative("a number, 0 or more, such as 1e-9"));
  add_value(compare, "--within-db X", asked->within_db,
            "Take errors in dB over rows whose reference is this close to its peak; default 20", decibels);
  for (const auto& [name, columns] : {std::pair{"--result-columns OURS=THEIRS,...", &asked->result_columns},
                                      {"--reference-columns OURS=THEIRS,...", &asked->reference_columns}})
    add_value(compare, name, *columns, "Columns of that table: hfss, feko, matlab, azel, or OURS=THEIRS[*FACTOR][+OFFSET],...");
  add_value(compare, "--min-matched N", asked->min_matched,
            "Exit with 1 if fewer rows than this have a partner; default with a tolerance: all of the smaller table",
            whole_number(1, 1000000000));
  compare
      .add_option_function<std::string>(
          "--columns", [asked](const std::string& columns) { asked->result_columns = asked->reference_columns = columns; },
          "Columns of both tables: hfss, feko, matlab, azel, or as for --result-columns")
      ->type_name("PRESET");
  add_json_option(compare, asked->json);
  compare.add_flag("--free-scale", asked->free_scale,
                   "First multiply A by the one complex factor that brings it nearest to B, and print it");
  compare.add_flag("--no-register", asked->no_register, "Compare images as they lie, without aligning them first");
  add_value(compare, "--only COLUMN=LOW:HIGH", asked->only,
            "Take only these rows: COLUMN=VALUE or COLUMN=LOW:HIGH; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return set_action(line, compare, [asked, &line] {
    for (std::filesystem::path* file : {&asked->result, &asked->reference}) *file = result_in(*file);
    if (is_image_file(asked->result, parsed_column_map("--result-columns", asked->result_columns)) ||
        is_image_file(asked->reference, parsed_column_map("--reference-columns", asked->reference_columns)))
      line.exit_code = run_python(line.words);
    else
      compare_tables(*asked);
  });
}

}  // namespace raytube
