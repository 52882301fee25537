#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "error.h"
#include "program/commands.h"

namespace raytube {

namespace {

constexpr const char* run_examples =
    "Writes rcs.csv, channels.csv, rcs.png, rcs.svg and run.json.\n\n"
    "Examples:\n"
    "  raytube run cases/dihedral/case.toml\n"
    "  raytube run case.toml -o results --threads 4 --parts\n"
    "  raytube run case.toml --set tubes.per_wavelength=20 --set edges.method=none";
constexpr const char* check_examples =
    "Prints the resolved case, the mesh report, the wedges, what will be skipped and the expected cost.\n\n"
    "Examples:\n"
    "  raytube check case.toml --set target.unit=mm\n"
    "  raytube check case.toml --wedges wedges.csv";
constexpr const char* trace_examples =
    "Prints every bounce of the tube at (U, V).\n\n"
    "Example:\n"
    "  raytube trace case.toml --look 0 --u 0.01 --v -0.02";

void add_case_options(CLI::App& command, Request& request) {
  command.add_option("case", request.case_file, "Case file (TOML)")->required()->type_name("CASE.toml");
  command.add_option("--set", request.overrides, "Override a case key: KEY=VALUE with a dotted key; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

CLI::App* add_command(CLI::App& app, const char* name, const char* description, const char* examples) {
  CLI::App* command = app.add_subcommand(name, description);
  command->footer(examples);
  return command;
}

CLI::App* add_run(CLI::App& app, Request& request) {
  CLI::App* run = add_command(app, "run", "Compute a case and write the results", run_examples);
  add_case_options(*run, request);
  run->add_option("-o,--output", request.output_folder, "Folder for the results; default <case folder>/out")
      ->type_name("DIR")
      ->check([](const std::string& name) { return name.empty() ? "needs the name of a folder" : std::string(); });
  run->add_option("--threads", request.threads, "Number of threads; default all cores")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  run->add_flag("--parts", request.parts, "Also write parts.csv: S split by bounce and edges");
  run->add_flag("--quiet", request.quiet, "No progress bar, no summary");
  return run;
}

CLI::App* add_check(CLI::App& app, Request& request) {
  CLI::App* check = add_command(app, "check", "Report on a case without computing it", check_examples);
  add_case_options(*check, request);
  check->add_option("--wedges", request.wedges_csv, "Also write a list of all wedges")->type_name("FILE.csv");
  return check;
}

CLI::App* add_trace(CLI::App& app, Request& request) {
  CLI::App* trace = add_command(app, "trace", "Replay one tube, bounce by bounce", trace_examples);
  add_case_options(*trace, request);
  trace->add_option("--look", request.look, "Direction pair, counted from 0")
      ->required()
      ->type_name("I")
      ->check(CLI::Range(0, 1000000000));
  trace->add_option("--u", request.u, "Launch coordinate along phi-hat, from the mesh's origin [m]")->required()->type_name("U");
  trace->add_option("--v", request.v, "Launch coordinate along minus theta-hat, from the mesh's origin [m]")
      ->required()
      ->type_name("V");
  return trace;
}

void add_later(CLI::App& app, const std::string& name) {
  CLI::App* later = app.add_subcommand(name, "Not in this version");
  later->allow_extras();
  later->callback([name] { throw InputError("the command \"" + name + "\" is not in this version; see raytube --help"); });
}

// CLI11 would only say that a subcommand is required.
void check_first_word(const CLI::App& app, int argc, const char* const* argv) {
  if (argc < 2) throw InputError("no command; write run, check or trace and a case file (see raytube --help)");
  const std::string word = argv[1];
  const auto commands = app.get_subcommands([&](const CLI::App* command) { return command->get_name() == word; });
  if (commands.empty() && word != "--help" && word != "-h" && word != "--version")
    throw InputError(fmt::format("unknown command \"{}\"; write run, check or trace (see raytube --help)", word));
}

}  // namespace

Request parse_command_line(int argc, const char* const* argv) {
  Request request;
  CLI::App app("Radar cross-section of a triangle mesh by shooting and bouncing rays", "raytube");
  app.set_version_flag("--version", "raytube " RAYTUBE_VERSION);
  app.require_subcommand(1);
  app.footer("Help on a command: raytube run --help\nExample:           raytube run cases/dihedral/case.toml");
  CLI::App* run = add_run(app, request);
  CLI::App* check = add_check(app, request);
  CLI::App* trace = add_trace(app, request);
  for (const char* name : {"converge", "compare"}) add_later(app, name);
  check_first_word(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw InputError(std::string(error.what()) + "; see raytube --help");
    app.exit(error);
    return request;
  }
  request.command = *run ? Command::run : *check ? Command::check : *trace ? Command::trace : Command::none;
  return request;
}

}  // namespace raytube
