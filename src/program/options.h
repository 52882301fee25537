// Options that several commands have: small structs, and functions that add their options to a command.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "program/commands.h"

namespace raytube {

/// A case file, and the keys of it that --set overrides.
struct CaseInput {
  std::filesystem::path file;
  std::vector<std::string> overrides;
};

/// How a command works, whatever it does.
struct Work {
  std::string command;     // its name
  int threads = 0;         // 0: all cores
  bool quiet = false;      // neither progress nor summary
  Ranks* ranks = nullptr;  // the job that this process belongs to; null: the process is alone
};

/// A case to be run: by raytube run, from shards, or before its product.
struct RunOptions {
  CaseInput input;
  std::filesystem::path output;  // a folder, or one file (.nc); empty: <case folder>/out
  Work work;
  bool parts = false;   // also S by mechanism
  bool resume = false;  // continue an interrupted run
  std::optional<std::string> shard;
};

void add_set_option(CLI::App& command, CaseInput& input);
void add_case_options(CLI::App& command, CaseInput& input);
void add_output_option(CLI::App& command, std::filesystem::path& output, const char* description);
void add_threads_option(CLI::App& command, int& threads);
void add_machine_options(CommandLine& line, CLI::App& command, Work& work);
void add_quiet_option(CLI::App& command, bool& quiet, const char* summary);
void add_json_option(CLI::App& command, bool& json);

/// The number that the whole of `text` stands for.
std::optional<std::uint64_t> parsed_whole_number(std::string_view text);

/// Checks for CLI11: they return an empty text, or what is wrong.
using OptionCheck = std::function<std::string(const std::string&)>;
OptionCheck whole_number(std::uint64_t least, std::uint64_t most);
OptionCheck number_between(double least, double most);
OptionCheck name_of_a(const char* what);

/// Adds an option with a value, or a word without an option: "-n,--count N" are its names and the name of its value.
template <class App, class Value>
auto* add_value(App& command, const std::string& names, Value& value, const std::string& description,
                const OptionCheck& check = {}) {
  const std::size_t blank = names.find(' ');
  auto* const option = command.add_option(names.substr(0, blank), value, description)->type_name(names.substr(blank + 1));
  return check ? option->check(check) : option;
}

/// Lengths that an option takes [m].
inline constexpr double least_length = 1e-6, most_length = 1e6;

}  // namespace raytube
