// Options that commands have in common, and those of commands that make something of a sweep.
#pragma once

#include <fmt/format.h>

#include <charconv>
#include <string>

#include "program/commands.h"

namespace CLI {
class App;
}

namespace raytube {

CLI::App* add_command(CLI::App& app, const char* name, const char* description, const char* examples);

/// A check of CLI11 for whole numbers.
inline auto whole_number(std::uint64_t least, std::uint64_t most) {
  return [least, most](const std::string& text) -> std::string {
    std::uint64_t number = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error == std::errc() && stop == end && number >= least && number <= most) return "";
    return fmt::format("needs a whole number from {} to {} (found {})", least, most, text);
  };
}

void add_set_option(CLI::App& command, Request& request);
void add_case_options(CLI::App& command, Request& request);
void add_output_option(CLI::App& command, Request& request, const char* description);
void add_threads_option(CLI::App& command, Request& request);
void add_machine_options(CLI::App& command, Request& request);
void add_json_option(CLI::App& command, Request& request);
void add_quiet_option(CLI::App& command, Request& request, const char* summary);

CLI::App* add_profile(CLI::App& app, Request& request);
CLI::App* add_centres(CLI::App& app, Request& request);
CLI::App* add_isar(CLI::App& app, Request& request);

/// Throws InputError for options of profile and isar that do not go together.
void check_product_options(const CLI::App& command, Request& request);

}  // namespace raytube
