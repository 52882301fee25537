#include "program/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>

#include "core/csv_reader.h"
#include "core/instruction_set.h"
#include "ranks/ranks.h"

namespace raytube {

void add_set_option(CLI::App& command, CaseInput& input) {
  add_value(command, "--set KEY=VALUE", input.overrides, "Override a case key: KEY=VALUE with a dotted key; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_case_options(CLI::App& command, CaseInput& input) {
  add_value(command, "case CASE.toml", input.file, "Case file (TOML)")->required();
  add_set_option(command, input);
}

void add_output_option(CLI::App& command, std::filesystem::path& output, const char* description) {
  add_value(command, "-o,--output DIR", output, description, name_of_a("folder"));
}

void add_threads_option(CLI::App& command, int& threads) {
  add_value(command, "-j,--threads N", threads, "Number of threads; default all cores", whole_number(1, 4096));
}

void add_machine_options(CommandLine& line, CLI::App& command, Work& work) {
  work.command = command.get_name();
  work.ranks = line.ranks;
  if (line.ranks) work.threads = line.ranks->threads();
  add_threads_option(command, work.threads);
  command
      .add_option_function<std::string>(
          "--instruction-set", limit_instruction_set,
          "Widest instruction set to use (sse2, sse4.2, avx, avx2, avx512); does not change results")
      ->type_name("NAME");
}

void add_quiet_option(CLI::App& command, bool& quiet, const char* summary) {
  command.add_flag("-q,--quiet", quiet, fmt::format("Print neither progress nor {}; warnings are still printed", summary));
}

void add_json_option(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "Print one JSON document for scripts instead of the text");
}

std::optional<std::uint64_t> parsed_whole_number(std::string_view text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

OptionCheck whole_number(std::uint64_t least, std::uint64_t most) {
  return [least, most](const std::string& text) -> std::string {
    const std::optional<std::uint64_t> number = parsed_whole_number(text);
    if (number && *number >= least && *number <= most) return "";
    return fmt::format("needs a whole number from {} to {} (found {})", least, most, text);
  };
}

OptionCheck number_between(double least, double most) {
  return [least, most](const std::string& text) -> std::string {
    const std::optional<double> number = parsed_number(text);
    if (number && *number >= least && *number <= most) return "";
    return fmt::format("needs a number from {:g} to {:g} (found {})", least, most, text);
  };
}

OptionCheck name_of_a(const char* what) {
  return [what](const std::string& name) { return name.empty() ? fmt::format("needs the name of a {}", what) : ""; };
}

}  // namespace raytube
