#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "case/text/keys.h"
#include "core/csv_reader.h"
#include "core/error.h"
#include "core/text.h"
#include "program/options.h"
#include "program/python.h"
#include "program/work/destination.h"

namespace raytube {

namespace {

constexpr const char* main_footer =
    "Help on a command: raytube help run, or raytube run --help\n"
    "Example:           raytube run cases/dihedral/case.toml\n\n"
    "Exit codes:\n"
    "    0  done\n"
    "    1  compare found more than its tolerance\n"
    "    2  bad input: the case, a file, an option, or more work than fits; one sentence says what is wrong and what to do\n"
    "    3  the machine: disk, memory, or a package that is missing\n"
    "    4  done, but some rows must not be used\n"
    "  130  interrupted";

constexpr const char* run_examples =
    "Writes rcs.csv, channels.csv, rcs.png, rcs.svg and run.json. If interrupted, finished looks are kept; continue with "
    "--resume.\n"
    "-o FILE.nc writes that netCDF file alone, which holds all of rcs.csv, the mechanisms and the resolved case.\n"
    "A mesh in place of the case takes --unit, --ghz and --azimuth; the case made of them is written as case.toml beside the "
    "results.\n\n"
    "Examples:\n"
    "  raytube run cases/dihedral/case.toml\n"
    "  raytube run car.stl --unit m --ghz 10 --azimuth 0:360:1\n"
    "  raytube run case.toml -o results --threads 4 --parts\n"
    "  raytube run case.toml --set tubes.per_wavelength=20 --set edges.method=none\n"
    "  raytube run case.toml --resume\n"
    "  raytube run case.toml -o result.nc\n"
    "  raytube run case.toml --shard 3/7 -o shards      (one of seven; then raytube merge shards)\n"
    "  raytube run case.toml --launch random --samples 100000 --seed 1 --repeat 10      (also writes random.csv)";
constexpr const char* merge_examples =
    "Writes what one run would have written, byte for byte, once all shards of one case, mesh and program are there.\n\n"
    "Examples:\n"
    "  raytube run case.toml --shard 1/2 -o shards; raytube run case.toml --shard 2/2 -o shards; raytube merge shards\n"
    "  raytube merge shards -o result.nc";
constexpr const char* check_examples =
    "Prints the resolved case, the mesh report, the wedges, what will be skipped and the expected cost.\n\n"
    "Examples:\n"
    "  raytube check case.toml --set target.unit=mm\n"
    "  raytube check case.toml --threads 8\n"
    "  raytube check case.toml --ranks 64 --threads 4\n"
    "  raytube check case.toml --wedges wedges.csv\n"
    "  raytube check case.toml --wedges wedges.vtp";
constexpr const char* trace_examples =
    "Prints every bounce of the tube at (U, V), follows all tubes of a look, or writes the rays that waves over curved surfaces\n"
    "follow.\n\n"
    "Examples:\n"
    "  raytube trace case.toml --look 0 --u 0.01 --v -0.02\n"
    "  raytube trace case.toml --look 0 --all --paths paths.vtp --hits hits.vtu\n"
    "  raytube trace case.toml --look 0 --surface-rays surface_rays.vtp";

constexpr const char* compare_examples =
    "A and B are tables with a header: rcs.csv, channels.csv, or any file with freq_hz, theta_deg, phi_deg[, rx_theta_deg, "
    "rx_phi_deg]\n"
    "and, for each channel pq = vv, vh, hv, hh, re_pq and im_pq [m], magnitude_pq (root of sigma) and phase_pq_rad, or "
    "sigma_pq_dbsm.\n"
    "Rows with equal frequency and angles are compared.\n"
    "A netCDF file (.nc) of raytube's will do, too.\n"
    "Images are compared with images, after the one is shifted onto the other: image.csv, what raytube isar writes, a table with "
    "a\n"
    "row for each pixel (col and row, or u_m and v_m) and channels as above, or OpenEXR, whose channels are its columns.\n"
    "With -o it also writes compare.csv, compare.png and, of tables, compare.svg.\n\n"
    "Examples:\n"
    "  raytube compare out/rcs.csv reference.csv\n"
    "  raytube compare render.exr out/image.csv --result-columns magnitude_vv=VV.mag --free-scale -o comparison\n"
    "  raytube compare out/rcs.csv reference.csv -o comparison --tolerance-db 0.5\n"
    "  raytube compare a.csv b.csv --only phi_deg=-45:45 --within-db 40\n"
    "  raytube compare out/rcs.csv renderer.csv --reference-columns \"freq_hz=f*1e9,theta_deg=el*-1+90,phi_deg=az\"";

constexpr const char* converge_examples =
    "Solves the whole case at each density, coarse ones first, in place of its tubes.per_wavelength. Prints the observed order, "
    "the\n"
    "extrapolated value with its uncertainty, and which density is fine enough. Writes converge.csv, converge.png and "
    "converge.svg.\n"
    "Interrupted, it leaves converge.csv with the densities it finished.\n"
    "Given netCDF files of runs with uniform tubes in place of the case, it computes nothing and studies these.\n\n"
    "Examples:\n"
    "  raytube converge cases/convergence/case.toml\n"
    "  raytube converge case.toml --densities 5,10,20 --set look.phi_deg=0\n"
    "  raytube converge n5.nc n10.nc n20.nc -o study";

constexpr const char* convert_examples =
    "There and back gives the same numbers bit for bit, and of a table that raytube has written the same bytes. A table holds "
    "no\n"
    "parts and no attributes. Replaces only what raytube has written.\n\n"
    "Examples:\n"
    "  raytube convert out/rcs.csv rcs.nc\n"
    "  raytube convert rcs.nc rcs.csv";

constexpr const char* sources_examples =
    "Traces a scene of named parts from a point, with rays launched by six models, and counts what they hit. Writes "
    "sources.csv,\n"
    "hits.ply and pictures of the launch points, of the hits on one part and of the errors against rays and time.\n\n"
    "Examples:\n"
    "  raytube sources cases/double_slit/case.toml\n"
    "  raytube sources case.toml --set source.rays=1000000 --set source.models=geometry";

// Random tubes of a run: none of these options means anything without the first.
void add_random_options(CLI::App& run, Request& request) {
  RandomOptions& random = request.random.emplace();
  CLI::Option* launch =
      run.add_option("--launch", "random: tubes at random places, as a path tracer has them; default those of the case")
          ->type_name("random")
          ->check([](const std::string& kind) {
            return kind == "random" ? "" : "write random, or leave it out (found " + kind + ")";
          });
  run.add_option("--samples", random.samples, "Random tubes a look; default 100000")
      ->type_name("N")
      ->needs(launch)
      ->check(whole_number(1, 1000000000));
  run.add_option("--seed", random.seed, "Seed of the random numbers; default 1")
      ->type_name("S")
      ->needs(launch)
      ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()));
  run.add_option("--repeat", random.runs, "Independent random runs, which give the spread; default 10")
      ->type_name("R")
      ->needs(launch)
      ->check(whole_number(2, 1000000));
}

// Of a mesh in the place of a case.
void add_mesh_options(CLI::App& run, MeshRequest& mesh) {
  run.add_option("--unit", mesh.unit, "Of a mesh: length of its unit (m, cm, mm, um, in, ft)")->type_name("UNIT");
  run.add_option("--ghz", mesh.ghz, "Of a mesh: frequencies, one, a list, or START:STOP:COUNT")->type_name("F");
  run.add_option("--azimuth", mesh.azimuth, "Of a mesh: azimuths in degrees, one, a list, or START:STOP:STEP; default 0")
      ->type_name("DEG");
  run.add_option("--elevation", mesh.elevation, "Of a mesh: elevations in degrees, in the same ways; default 0")
      ->type_name("DEG");
}

CLI::App* add_run(CLI::App& app, Request& request) {
  CLI::App* run = add_command(app, "run", "Compute a case and write the results", run_examples);
  run->add_option("case", request.case_file, "Case file (TOML), or a mesh with --unit and --ghz")
      ->required()
      ->type_name("CASE.toml|MESH");
  add_set_option(*run, request);
  add_mesh_options(*run, request.mesh);
  add_output_option(*run, request, "Folder for the results, or FILE.nc; default <case folder>/out");
  add_machine_options(*run, request);
  run->add_flag("--parts", request.parts, "Also write parts.csv and parts.png: S by mechanism");
  run->add_flag("--resume", request.resume, "Continue an interrupted run: keep the finished looks in the folder");
  run->add_option("--shard", request.shard,
                  "Compute (or continue) part I of N of the looks, for raytube merge; slurm: the task of a job array")
      ->type_name("I/N|slurm");
  add_quiet_option(*run, request, "summary");
  add_random_options(*run, request);
  return run;
}

CLI::App* add_merge(CLI::App& app, Request& request) {
  CLI::App* merge = add_command(app, "merge", "Put the shards of a run together", merge_examples);
  merge->add_option("shards", request.merged_folder, "Folder of the shards")->required()->type_name("DIR");
  merge->add_option("case", request.case_file, "Case file (TOML), if it is no longer where the shards were made")
      ->type_name("CASE.toml");
  add_output_option(*merge, request, "Folder for the results, or FILE.nc; default that of the shards");
  add_machine_options(*merge, request);
  merge->add_flag("--parts", request.parts, "Also write parts.csv: S by mechanism");
  add_quiet_option(*merge, request, "summary");
  return merge;
}

CLI::App* add_check(CLI::App& app, Request& request) {
  CLI::App* check = add_command(app, "check", "Report on a case without computing it", check_examples);
  add_case_options(*check, request);
  add_threads_option(*check, request);
  check
      ->add_option("--ranks", request.planned_ranks,
                   "Also predict time and memory of a job of N processes (mpirun -n N) with --threads threads each")
      ->type_name("N")
      ->check(whole_number(1, 1000000));
  add_json_option(*check, request);
  check->add_option("--wedges", request.wedge_list, "Also write a list of all wedges: a table, or lines for ParaView")
      ->type_name("FILE.csv|FILE.vtp");
  return check;
}

// As a check of CLI11: empty, or what is wrong.
std::string not_a_name(const std::string& name) { return name.empty() ? "needs the name of a file" : ""; }

void add_all_tubes_options(CLI::App& trace, Request& request) {
  CLI::Option* all = trace.add_flag("--all", request.all_tubes, "Follow all tubes of the look and print where they go");
  trace.add_option("--tubes", request.most_tubes, "Follow at most N of them, evenly spread; default 10000")
      ->type_name("N")
      ->needs(all)
      ->check(whole_number(1, 1000000));
  trace.add_option("--paths", request.tube_paths_vtp, "Write their paths as lines, for ParaView")
      ->type_name("FILE.vtp")
      ->needs(all)
      ->check(not_a_name);
  trace.add_option("--hits", request.facet_hits_vtu, "Write how many of them hit each facet, by bounce, for ParaView")
      ->type_name("FILE.vtu")
      ->needs(all)
      ->check(not_a_name);
}

CLI::App* add_trace(CLI::App& app, Request& request) {
  CLI::App* trace = add_command(app, "trace", "Replay tubes, bounce by bounce; rays over curved surfaces", trace_examples);
  add_case_options(*trace, request);
  trace->add_option("--look", request.look, "Direction pair, counted from 0")
      ->required()
      ->type_name("I")
      ->check(whole_number(0, 1000000000));
  trace
      ->add_option("--u", request.u,
                   "Launch coordinate along phi-hat, from the mesh's origin [m]; not needed with --all or --surface-rays")
      ->type_name("U");
  trace->add_option("--v", request.v, "Launch coordinate along minus theta-hat, from the mesh's origin [m]")->type_name("V");
  trace->add_option("--surface-rays", request.surface_rays_vtp, "Write the rays of waves over curved surfaces, for ParaView")
      ->type_name("FILE.vtp")
      ->check(not_a_name);
  add_all_tubes_options(*trace, request);
  return trace;
}

// As a check of CLI11: empty, or what is wrong.
std::string not_decibels(const std::string& text) {
  const std::optional<double> number = parsed_number(text);
  return number && std::isfinite(*number) && *number >= 0.0 ? "" : "needs a number of decibels, 0 or more (found " + text + ")";
}

std::string not_relative(const std::string& text) {
  const std::optional<double> number = parsed_number(text);
  return number && std::isfinite(*number) && *number >= 0.0 ? "" : "needs a number, 0 or more, such as 1e-9 (found " + text + ")";
}

CLI::App* add_compare(CLI::App& app, Request& request) {
  CLI::App* compare = add_command(app, "compare", "Measure how far a result is from a reference", compare_examples);
  compare->add_option("result", request.result, "Table or image to be judged")->required()->type_name("A.csv|A.nc|A.exr");
  compare->add_option("reference", request.reference, "Table or image to judge it by")->required()->type_name("B.csv|B.nc|B.exr");
  add_output_option(*compare, request, "Folder for compare.csv and the picture; default none");
  compare->add_option("--tolerance-db", request.tolerance_db, "Exit with 1 (FAIL) if the rms error of a channel exceeds this")
      ->type_name("X")
      ->check(not_decibels);
  compare
      ->add_option("--tolerance-relative", request.tolerance_relative,
                   "Exit with 1 if ||A - B|| / ||B|| of complex S, over all rows and channels, exceeds this, or if one table has "
                   "rows or channels of its own")
      ->type_name("X")
      ->check(not_relative);
  compare
      ->add_option("--within-db", request.within_db,
                   "Errors in dB are over rows whose reference is this close to its peak; default 20")
      ->type_name("X")
      ->check(not_decibels);
  for (const auto& [name, columns] :
       {std::pair{"--result-columns", &request.result_columns}, std::pair{"--reference-columns", &request.reference_columns}})
    compare->add_option(name, *columns, "Columns of that table: hfss, feko, matlab, azel, or OURS=THEIRS[*FACTOR][+OFFSET],...")
        ->type_name("OURS=THEIRS,...");
  compare
      ->add_option("--min-matched", request.min_matched,
                   "Exit with 1 if fewer rows than this have a partner; default with a tolerance: all of the smaller table")
      ->type_name("N")
      ->check(whole_number(1, 1000000000));
  compare
      ->add_option_function<std::string>(
          "--columns", [&request](const std::string& columns) { request.result_columns = request.reference_columns = columns; },
          "Columns of both tables: hfss, feko, matlab, azel, or as for --result-columns")
      ->type_name("PRESET");
  add_json_option(*compare, request);
  compare->add_flag("--free-scale", request.free_scale,
                    "First multiply A by the one complex factor that brings it nearest to B, and print it");
  compare->add_flag("--no-register", request.no_register, "Compare images as they lie, without aligning them first");
  compare->add_option("--only", request.only, "Only rows with this: COLUMN=VALUE or COLUMN=LOW:HIGH; may be repeated")
      ->type_name("COLUMN=LOW:HIGH")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return compare;
}

CLI::App* add_converge(CLI::App& app, Request& request) {
  CLI::App* converge = add_command(app, "converge", "Study how a case converges with tube density", converge_examples);
  converge->add_option("case", request.studied, "Case file (TOML), or netCDF files of runs at different densities")
      ->required()
      ->type_name("CASE.toml|FILE.nc...");
  add_set_option(*converge, request);
  add_output_option(*converge, request, "Folder for the results; default <case folder>/out, or out beside the first netCDF file");
  add_machine_options(*converge, request);
  converge->add_option("--densities", request.densities, "Tubes per wavelength, at least three; default 2,4,8,16,32,64")
      ->type_name("N,N,...");
  add_quiet_option(*converge, request, "table");
  return converge;
}

// One case, or results of several runs.
void sort_out_studied(const CLI::App& converge, Request& request) {
  std::vector<std::filesystem::path>& files = request.studied;
  for (std::filesystem::path& file : files) file = result_in(file, std::array{"rcs.nc"});
  if (files.size() == 1 && lower_case(files.front().extension().string()) != ".nc") {
    request.case_file = files.front();
    request.studied.clear();
    return;
  }
  for (const std::filesystem::path& file : files)
    if (lower_case(file.extension().string()) != ".nc")
      throw InputError(fmt::format("{}: is no netCDF file; converge takes one case, or netCDF files (.nc) alone", file.string()));
  for (const char* option : {"--set", "--densities", "--threads", "--instruction-set"})
    if (converge.count(option) > 0)
      throw InputError(fmt::format("{}: means nothing for results that are there; leave it out, or give a case", option));
}

CLI::App* add_convert(CLI::App& app, Request& request) {
  CLI::App* convert = add_command(app, "convert", "Convert rcs.csv to netCDF, or back", convert_examples);
  convert->add_option("from", request.result, "Input file")->required()->type_name("A.csv|A.nc");
  convert->add_option("to", request.reference, "Output file")->required()->type_name("B.nc|B.csv");
  return convert;
}

CLI::App* add_sources(CLI::App& app, Request& request) {
  CLI::App* sources = add_command(app, "sources", "Count what rays from a point hit, for six launch models", sources_examples);
  add_case_options(*sources, request);
  add_output_option(*sources, request, "Folder for the results; default <case folder>/out");
  add_machine_options(*sources, request);
  add_quiet_option(*sources, request, "table");
  return sources;
}

// A tube needs both of its coordinates; who asks for all tubes or for surface rays may do without.
bool wants_tube(const CLI::App& trace) {
  const bool u = trace.count("--u") > 0, v = trace.count("--v") > 0;
  if (u != v || (!u && trace.count("--all") + trace.count("--surface-rays") == 0))
    throw InputError(
        fmt::format("{} is required, with {} and --look; see raytube trace --help", u ? "--v" : "--u", u ? "--u" : "--v"));
  return u;
}

// Help in two columns; of an option no more than its value's name.
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

// What CLI11 says of a word that it does not know names neither the nearest option nor the command.
std::string unknown_word(const CLI::App& command, const std::vector<std::string>& words) {
  const auto option = std::ranges::find_if(words, [](const std::string& word) { return word.starts_with('-'); });
  if (option == words.end()) return fmt::format("unexpected argument {}", quotable(words.front()));
  std::vector<std::string> known;
  for (const CLI::Option* each : command.get_options())
    for (const std::string& name : each->get_lnames()) known.push_back("--" + name);
  const std::string name = option->substr(0, option->find('='));
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
  std::ranges::reverse(words);  // as CLI11 takes them
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

}  // namespace

Request parse_command_line(int argc, const char* const* argv) {
  Request request;
  CLI::App app("Radar cross-section of a triangle mesh by shooting and bouncing rays", "raytube");
  app.formatter(std::make_shared<HelpLayout>());
  app.set_version_flag("--version", "raytube " RAYTUBE_VERSION);
  app.require_subcommand(1);
  app.footer(main_footer);
  const auto add = [&](const char* group, void (*action)(const Request&), CLI::App* subcommand, bool shared = false) {
    subcommand->group(group)->final_callback([&request, action, shared] { request.action = action, request.shared = shared; });
    return subcommand;
  };
  const CLI::App* run = add("Compute", run_command, add_run(app, request), true);
  add("Compute", merge_command, add_merge(app, request));
  const CLI::App* converge = add("Compute", converge_command, add_converge(app, request), true);
  const CLI::App* profile = add("Compute", profile_command, add_profile(app, request), true);
  const CLI::App* isar = add("Compute", isar_command, add_isar(app, request), true);
  const CLI::App* centres = add("Compute", centres_command, add_centres(app, request));
  add("Compute", sources_command, add_sources(app, request));
  add("Inspect", check_command, add_check(app, request));
  const CLI::App* trace = add("Inspect", trace_command, add_trace(app, request));
  add("Compare and convert", compare_command, add_compare(app, request));
  add("Compare and convert", convert_command, add_convert(app, request));
  for (const auto& [name, description] : python_commands) {  // which has their options, and their help
    CLI::App* const command = app.add_subcommand(name, description)->group("Show (by the Python package)")->prefix_command();
    command->set_help_flag();
    command->final_callback([&request] { request.by_python = true; });
  }
  try {
    request.words = words_of(argc, argv);
    parse(app, request.words);
  } catch (const CLI::Success& help) {
    app.exit(help);
    return request;
  }
  if (run->count("--launch") == 0) request.random.reset();
  if (request.random && request.parts)
    throw InputError("--parts: the mean of random tubes is not kept apart by mechanism; leave out --parts or --launch random");
  if (request.shard && request.parts)
    throw InputError("--parts: shards always keep the mechanisms; leave it out, and give it to raytube merge");
  if (request.random && request.resume)
    throw InputError("--resume: random tubes are always drawn anew as a whole; leave out --resume or --launch random");
  if (*converge) sort_out_studied(*converge, request);
  if (*centres) request.product.direct = true;
  if (*trace) request.tube = wants_tube(*trace);
  for (const CLI::App* product : {profile, isar})
    if (*product) check_product_options(*product, request);
  return request;
}

}  // namespace raytube
