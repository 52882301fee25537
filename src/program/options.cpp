#include "program/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "core/csv_reader.h"
#include "core/error.h"
#include "program/products.h"
#include "scene/scattering_piece.h"

namespace raytube {

void add_set_option(CLI::App& command, Request& request) {
  command.add_option("--set", request.overrides, "Override a case key: KEY=VALUE with a dotted key; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_case_options(CLI::App& command, Request& request) {
  command.add_option("case", request.case_file, "Case file (TOML)")->required()->type_name("CASE.toml");
  add_set_option(command, request);
}

void add_output_option(CLI::App& command, Request& request, const char* description) {
  command.add_option("-o,--output", request.output_folder, description)->type_name("DIR")->check([](const std::string& name) {
    return name.empty() ? "needs the name of a folder" : std::string();
  });
}

void add_threads_option(CLI::App& command, Request& request) {
  command.add_option("-j,--threads", request.threads, "Number of threads; default all cores")
      ->type_name("N")
      ->check(whole_number(1, 4096));
}

void add_machine_options(CLI::App& command, Request& request) {
  add_threads_option(command, request);
  command
      .add_option("--instruction-set", request.instruction_set,
                  "Widest instruction set to use (sse2, sse4.2, avx, avx2, avx512); does not change results")
      ->type_name("NAME");
}

void add_quiet_option(CLI::App& command, Request& request, const char* summary) {
  command.add_flag("-q,--quiet", request.quiet,
                   fmt::format("Print neither progress nor {}; warnings are still printed", summary));
}

void add_json_option(CLI::App& command, Request& request) {
  command.add_flag("--json", request.json, "Print one JSON document for scripts instead of the text");
}

CLI::App* add_command(CLI::App& app, const char* name, const char* description, const char* examples) {
  CLI::App* command = app.add_subcommand(name, description);
  command->footer(examples);
  return command;
}

namespace {

constexpr const char* profile_examples =
    "Writes profile.csv, profile.png and .svg, of several looks also waterfall.png and .svg. A case is run first: all that "
    "raytube\n"
    "run writes is in the folder, too; stopped in any way, it leaves its finished looks there for --resume.\n\n"
    "Examples:\n"
    "  raytube profile out/rcs.csv\n"
    "  raytube profile case.toml -o profile --window hann\n"
    "  raytube profile rcs.nc -o profile.nc --window taylor --sidelobes 50";

constexpr const char* centres_examples =
    "Takes everything that scatters at the middle frequency to pieces, and finds the strongest places: amplitude of all "
    "channels, mechanism, "
    "over which\nband and angles it persists. Writes centres.csv, centres.png, centres.ply and by_part.csv.\n\n"
    "Examples:\n"
    "  raytube centres cases/trihedral/case.toml --look 20\n"
    "  raytube centres case.toml -n 20 --resolution 0.05 -o centres";

constexpr const char* isar_examples =
    "Frequencies by one angle give an image in a plane, by azimuth and elevation one in space. Writes isar.csv, isar.png, "
    "isar_pauli.png and "
    "isar.vti (for\n"
    "ParaView). A case is run first: all that raytube run writes is in the folder, too; stopped in any way, it leaves its "
    "finished "
    "looks\n"
    "there for --resume. --plan prints the frequencies and looks that a target asks for.\n\n"
    "Examples:\n"
    "  raytube isar --plan 6 0.1 --ghz 10\n"
    "  raytube isar case.toml -o image\n"
    "  raytube isar out/rcs.csv -o image --window hann --size 8x8";

// As checks of CLI11: empty, or what is wrong.
std::string not_a_window(const std::string& name) {
  return window_of_name(name) ? "" : "needs rectangular, hann, hamming, taylor or kaiser (found " + name + ")";
}

std::string not_a_mechanism(const std::string& name) {
  const bool known = std::ranges::find(scattering_mechanisms, std::string_view(name)) != scattering_mechanisms.end();
  return known ? "" : fmt::format("needs {} (found {})", fmt::join(scattering_mechanisms, ", "), name);
}

auto number_between(double least, double most) {
  return [least, most](const std::string& text) -> std::string {
    const std::optional<double> number = parsed_number(text);
    return number && *number >= least && *number <= most
               ? ""
               : fmt::format("needs a number from {:g} to {:g} (found {})", least, most, text);
  };
}

constexpr double least_length = 1e-6, most_length = 1e6;  // [m]

void add_product_options(CLI::App& command, Request& request) {
  Window& window = request.product.window;
  command
      .add_option_function<std::string>(
          "--window", [&window](const std::string& name) { window.kind = *window_of_name(name); },
          "rectangular, hann, hamming, taylor (the default) or kaiser: lower side lobes, wider peaks")
      ->type_name("NAME")
      ->check(not_a_window);
  command.add_option("--sidelobes", window.sidelobe_db, "taylor, kaiser: side lobes so far below the peak; default 35")
      ->type_name("DB")
      ->check(number_between(least_sidelobe_db, most_sidelobe_db));
  CLI::Option* direct = command.add_flag(
      "--direct", request.product.direct,
      "Of a case: from where every current is, in the middle look at the middle frequency; the sweep is not computed");
  command
      .add_option("--mechanisms", request.product.mechanisms,
                  fmt::format("With --direct, these alone: {}", fmt::join(scattering_mechanisms, ", ")))
      ->type_name("NAME,...")
      ->delimiter(',')
      ->needs(direct)
      ->check(not_a_mechanism);
  add_set_option(command, request);
  command.add_flag("--resume", request.resume, "Go on with the looks that a run stopped before has left in the folder");
  add_output_option(command, request, "Folder for the results, or FILE.nc; default <case folder>/out, or that of the result");
  add_machine_options(command, request);
  add_quiet_option(command, request, "summary");
}

}  // namespace

CLI::App* add_profile(CLI::App& app, Request& request) {
  CLI::App* profile =
      add_command(app, "profile", "Range profiles of a sweep over frequency, and their waterfall", profile_examples);
  profile->add_option("input", request.result, "Result of a run, its folder, or a case to be run first")
      ->required()
      ->type_name("RESULT.csv|.nc|DIR|CASE.toml");
  profile->add_option("--padding", request.product.padding, "Ranges to a resolution cell; default 4")
      ->type_name("N")
      ->check(whole_number(1, 64));
  add_product_options(*profile, request);
  return profile;
}

CLI::App* add_isar(CLI::App& app, Request& request) {
  CLI::App* isar = add_command(app, "isar", "Image of a sweep over frequency and angle (ISAR)", isar_examples);
  isar->add_option("input", request.result, "Result of a run, its folder, or a case to be run first")
      ->type_name("RESULT.csv|.nc|DIR|CASE.toml");
  isar->add_option("--size", request.product.size_words,
                   "Of the image along range, cross-range and height [m]: 8x8, or 8 8; default the target's")
      ->type_name("MxM[xM]")
      ->expected(1, 4);
  isar->add_option("--pixels", request.product.pixels, "Cells of the image to a resolution cell; default 4")
      ->type_name("N")
      ->check(number_between(1.0, 32.0));
  isar->add_option("--plan", request.product.plan, "Print what a case needs for a target of this size at this resolution [m]")
      ->type_name("SIZE RESOLUTION")
      ->check(number_between(least_length, most_length));
  isar->add_option("--ghz", request.product.plan_ghz, "With --plan: the middle of the band; default 10")
      ->type_name("F")
      ->check(number_between(1e-6, 1e9));
  add_product_options(*isar, request);
  return isar;
}

CLI::App* add_centres(CLI::App& app, Request& request) {
  CLI::App* centres = add_command(app, "centres", "Scattering centres of a look", centres_examples);
  centres->add_option("case", request.result, "Case file (TOML)")->required()->type_name("CASE.toml");
  add_set_option(*centres, request);
  centres->add_option("--look", request.look, "Direction, counted from 0; default 0")
      ->type_name("I")
      ->check(whole_number(0, 1000000000));
  centres->add_option("-n,--count", request.product.centres, "Maximum number of centres; default 50")
      ->type_name("N")
      ->check(whole_number(1, 1000));
  centres
      ->add_option("--resolution", request.product.resolution,
                   "Of their places [m]; default what the case's band resolves, or a sixtieth of the target")
      ->type_name("M")
      ->check(number_between(least_length, most_length));
  add_output_option(*centres, request, "Folder for the results, or FILE.nc; default <case folder>/out");
  add_machine_options(*centres, request);
  add_quiet_option(*centres, request, "summary");
  add_json_option(*centres, request);
  return centres;
}

void check_product_options(const CLI::App& command, Request& request) {
  request.product.size = lengths_of_size(request.product.size_words, request.result);
  const WindowKind kind = request.product.window.kind;
  if (command.count("--sidelobes") > 0 && kind != WindowKind::taylor && kind != WindowKind::kaiser)
    throw InputError(
        fmt::format("--sidelobes: a {} window has side lobes of its own; leave it out, or write --window taylor or kaiser",
                    name_of(request.product.window)));
  if (command.get_name() != "isar") return;
  if (!request.product.plan && request.result.empty())
    throw InputError("input is required: a result or a case, or --plan SIZE RESOLUTION; see raytube isar --help");
  if (request.product.plan && !request.result.empty())
    throw InputError("--plan: computes nothing, so that it takes no result and no case; leave one out");
  for (const char* option : {"--output", "--set", "--resume", "--size", "--pixels", "--window", "--sidelobes", "--direct"})
    if (request.product.plan && command.count(option) > 0)
      throw InputError(fmt::format("{}: means nothing with --plan; leave it out", option));
  if (!request.product.plan && command.count("--ghz") > 0) throw InputError("--ghz: means nothing without --plan; leave it out");
}

}  // namespace raytube
