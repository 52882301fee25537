#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "case/text/keys.h"
#include "core/error.h"
#include "core/text.h"
#include "program/commands.h"
#include "program/python.h"
#include "ranks/ranks.h"

namespace raytube {

namespace {

constexpr const char* main_footer = R"(Help on a command: raytube help run, or raytube run --help
Example:           raytube run cases/dihedral/case.toml

Exit codes:
    0  done
    1  compare found more than its tolerance
    2  bad input: the case, a file, an option, or more work than fits; one sentence says what is wrong and what to do
    3  the machine: disk, memory, or a package that is missing
    4  done, but some rows must not be used
  130  interrupted)";

// Help in two columns, which shows the name of an option's value and nothing else about it.
class HelpLayout : public CLI::Formatter {
 public:
  HelpLayout() { column_width(34); }
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string value = option->get_type_name().empty() ? "" : ' ' + option->get_type_name();
    return option->get_required() && !option->get_positional() ? value + " REQUIRED" : value;
  }
};

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) names.push_back(command->get_name());
  return names;
}

// CLI11's own sentence about an unknown word names neither the nearest option nor the command.
std::string unknown_word(const CLI::App& command, const std::vector<std::string>& words) {
  const auto option = std::ranges::find_if(words, [](const std::string& word) { return word.starts_with('-'); });
  if (option == words.end()) return fmt::format("unexpected argument {}", quotable(words.front()));
  std::vector<std::string> known;
  for (const CLI::Option* each : command.get_options())
    for (const std::string& name : each->get_lnames()) known.push_back("--" + name);
  const std::string name = option->substr(0, option->find('='));
  if (name == "--launch") return "--launch random is gone; the Monte Carlo baseline is bench/monte_carlo now (cases/stochastic)";
  const std::string_view nearest = nearest_name(name, known);
  return fmt::format("unknown option {}{}", quotable(name), nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest));
}

// `raytube help run` is `raytube run --help`.
std::vector<std::string> words_of(int argc, const char* const* argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty()) return {"--help"};
  if (words.front() != "help") return words;
  words.erase(words.begin());
  words.emplace_back("--help");
  return words;
}

void parse(CLI::App& app, std::vector<std::string> words) {
  const std::string first = words.front();
  const std::vector<std::string> commands = command_names(app);
  if (!first.starts_with('-') && std::ranges::find(commands, first) == commands.end())
    throw InputError(fmt::format("unknown command \"{}\"; {}; see raytube --help", quotable(first), name_meant(first, commands)));
  std::ranges::reverse(words);  // CLI11 takes the last word first
  try {
    app.parse(words);
  } catch (const CLI::Success&) {
    throw;
  } catch (const CLI::ParseError& error) {
    const CLI::App& command = app.get_subcommands().empty() ? app : *app.get_subcommands().front();
    if (!command.remaining().empty())
      throw InputError(fmt::format("{}; see raytube {} --help", unknown_word(command, command.remaining()), first));
    throw InputError(fmt::format("{}; see raytube {}--help", error.what(), first.starts_with('-') ? "" : first + ' '));
  }
}

// The package has the options and the help of these commands.
void add_python_commands(CommandLine& line) {
  for (const auto& [name, description] : python_commands) {
    CLI::App& command = *line.app.add_subcommand(name, description)->group("Show (by the Python package)")->prefix_command();
    command.set_help_flag();
    set_action(line, command, [&line] { line.exit_code = run_python(line.words); });
  }
}

}  // namespace

CLI::App& add_command(CommandLine& line, const char* name, const char* description, const char* examples) {
  CLI::App& command = *line.app.add_subcommand(name, description);
  command.footer(examples);
  return command;
}

CLI::App& set_action(CommandLine& line, CLI::App& command, std::function<void()> act, std::function<void()> help) {
  command.final_callback([ranks = line.ranks, act = std::move(act), help = std::move(help)] {
    if (ranks && !help) throw InputError("this command does not share its work among processes; start it without mpirun");
    ranks && !ranks->leads() ? help() : act();
  });
  return command;
}

int run_command_line(int argc, const char* const* argv, Ranks* ranks) {
  CLI::App app("Radar cross-section of a triangle mesh by shooting and bouncing rays", "raytube");
  app.formatter(std::make_shared<HelpLayout>());
  app.set_version_flag("--version", "raytube " RAYTUBE_VERSION);
  app.require_subcommand(1);
  app.footer(main_footer);
  CommandLine line{app, ranks, words_of(argc, argv)};
  using AddCommand = CLI::App& (*)(CommandLine&);
  const std::pair<const char*, std::vector<AddCommand>> groups[] = {
      {"Compute", {add_run, add_merge, add_converge, add_profile, add_isar, add_doppler, add_centres, add_sources}},
      {"Inspect", {add_check, add_trace}},
      {"Compare and convert", {add_compare, add_convert}}};
  for (const auto& [group, commands] : groups)
    for (const AddCommand add : commands) add(line).group(group);
  add_python_commands(line);
  try {
    parse(app, line.words);
  } catch (const CLI::Success& help) {
    app.exit(help);
  }
  return line.exit_code;
}

}  // namespace raytube
