#include "program/products.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "case/read_case.h"
#include "case/target.h"
#include "core/csv_reader.h"
#include "core/error.h"
#include "core/ordered_json.h"
#include "core/text.h"
#include "core/threads.h"
#include "jobs/imaged_target.h"
#include "jobs/inputs.h"
#include "jobs/shared_work.h"
#include "jobs/solvable.h"
#include "output/compare/density_results.h"
#include "output/files/sha256.h"
#include "output/netcdf/netcdf_file.h"
#include "output/tables/stored.h"
#include "plan/mechanism.h"
#include "program/python.h"
#include "program/solve_warnings.h"
#include "program/work/progress_bar.h"
#include "solve/pieces.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

bool is_case(const fs::path& file) { return lower_case(file.extension().string()) == ".toml"; }

// Refuses every case that a run would refuse.
ProductSource source_of_pieces(const RunOptions& run) {
  const Case c = read_case(run.input.file, run.input.overrides);
  LoadedMesh loaded = load_target(c, true);
  warn_of_reading(c, loaded.report);
  const Manifest manifest = described_inputs(c, loaded.report, sha256_of_meshes(c, loaded.report));
  std::shared_ptr<const Target> target;
  run_on_threads(run.work.threads, [&] { target = std::make_shared<const Target>(std::move(loaded.mesh), c.wedges); });
  plan_of_case(*target, c, run.work.threads, false);
  ProductSource source = source_of(c, std::move(target));
  source.result.attributes = attributes_of(manifest);
  std::erase_if(source.result.attributes, [](const auto& each) {  // nothing is solved
    return each.first == "counts" || each.first == "warnings" || each.first == "model_uncertainty";
  });
  return source;
}

// The target of a result, if its meshes are still where the run found them, and unchanged.
std::shared_ptr<const Target> target_of(const Json& run) {
  try {
    const Case c = read_case(text_at(run, "case_file"), settings_of_run(run));
    LoadedMesh loaded = load_target(c);
    if (mesh_sha256_of_run(run) != sha256_of_meshes(c, loaded.report)) return {};
    return std::make_shared<const Target>(std::move(loaded.mesh), c.wedges);
  } catch (const InputError&) {
    return {};
  }
}

ProductSource stored_source(const fs::path& file) {
  ProductSource source{.of_case = {}, .name = file.string(), .title = file.filename().string(), .result = {}, .target = {}};
  source.result = is_netcdf_name(file) ? read_netcdf(file) : read_rcs_csv(file);
  if (const std::string title = attribute_of(source.result, "title"); !title.empty()) source.title = title;
  std::ifstream in(fs::absolute(file).parent_path() / "run.json");
  const Json run = json_of(std::string{std::istreambuf_iterator<char>(in), {}});
  if (run.is_discarded()) return source;
  const std::string table = is_netcdf_name(file) ? attribute_of(source.result, "rcs_csv_sha256") : sha256_of_file(file);
  if (text_at(run, "rcs_csv_sha256") != table) return source;
  if (const Json* const resolved = find(run, "case"); resolved && !text_at(*resolved, "title").empty())
    source.title = text_at(*resolved, "title");
  source.target = target_of(run);
  return source;
}

ProductSource source_without_run(const RunOptions& run, bool from_pieces) {
  const std::string file = run.input.file.string();
  if (run.work.ranks)
    throw InputError(fmt::format("{}: nothing is solved here for several processes to share; start a single one", file));
  if (run.resume)
    throw InputError(fmt::format("--resume: nothing is solved for {}, so that there is nothing to resume; leave it out", file));
  if (is_case(run.input.file)) return source_of_pieces(run);
  if (from_pieces) throw InputError(fmt::format("{} is not a case (.toml); only a case says where its S comes from", file));
  if (!run.input.overrides.empty())
    throw InputError(
        fmt::format("--set {}: has no effect on a finished result; leave it out, or give a case", run.input.overrides.front()));
  return stored_source(run.input.file);
}

}  // namespace

void add_sweep_input(CLI::App& command, SweepOptions& options, bool required) {
  add_value(command, "input RESULT.csv|.nc|DIR|CASE.toml", options.run.input.file,
            "Result of a run, its folder, or a case to be run first")
      ->required(required);
}

void add_window_options(CLI::App& command, Window& window) {
  command
      .add_option_function<std::string>(
          "--window", [&window](const std::string& name) { window.kind = *window_of_name(name); },
          "rectangular, hann, hamming, taylor (the default) or kaiser: lower side lobes, wider peaks")
      ->type_name("NAME")
      ->check([](const std::string& name) {
        return window_of_name(name) ? "" : "needs rectangular, hann, hamming, taylor or kaiser (found " + name + ")";
      });
  add_value(command, "--sidelobes DB", window.sidelobe_db, "taylor, kaiser: level of the side lobes below the peak; default 35",
            number_between(least_sidelobe_db, most_sidelobe_db));
}

void add_product_options(CommandLine& line, CLI::App& command, RunOptions& run) {
  add_set_option(command, run.input);
  command.add_flag("--resume", run.resume, "Continue an interrupted run: keep the finished looks in the folder");
  add_output_option(command, run.output, "Folder for the results, or FILE.nc; default <case folder>/out, or that of the result");
  add_machine_options(line, command, run.work);
  add_quiet_option(command, run.work.quiet, "summary");
}

void add_sweep_options(CommandLine& line, CLI::App& command, SweepOptions& options) {
  add_window_options(command, options.window);
  CLI::Option* direct = command.add_flag(
      "--direct", options.direct,
      "For a case: from the place of every current, in the middle look at the middle frequency, without the sweep");
  const std::vector<std::string> names = piece_names(mechanism_list());
  const std::string all = fmt::format("{}", fmt::join(names, ", "));
  add_value(command, "--mechanisms NAME,...", options.mechanisms, "With --direct, these alone: " + all,
            [names, all](const std::string& name) {
              const bool known = std::ranges::find(names, name) != names.end();
              return known ? "" : fmt::format("needs {} (found {})", all, name);
            })
      ->delimiter(',')
      ->needs(direct);
  add_product_options(line, command, options.run);
}

void check_sidelobes(const CLI::App& command, const Window& window) {
  if (command.count("--sidelobes") > 0 && window.kind != WindowKind::taylor && window.kind != WindowKind::kaiser)
    throw InputError(fmt::format(
        "--sidelobes: a {} window has side lobes of its own; leave it out, or write --window taylor or kaiser", name_of(window)));
}

ProductSource source_of(const Case& c, std::shared_ptr<const Target> target) {
  return {c, c.file.string(), c.title, stored_sweep(c.sweep), std::move(target)};
}

std::function<bool(double)> progress_of_pieces(bool quiet, std::size_t look, double frequency) {
  return [quiet, look, frequency, bar = std::shared_ptr<ProgressBar>()](double share) mutable {
    if (!bar)
      bar = std::make_shared<ProgressBar>(quiet, fmt::format("taking look {} at {:g} GHz to pieces", look, frequency * 1e-9));
    return bar->show(share);
  };
}

std::vector<dvec3> ProductSource::outermost() const { return target ? outermost_of(*target) : std::vector<dvec3>{}; }

std::vector<std::array<dvec3, 2>> ProductSource::lines() const {
  return target ? lines_of(*target) : std::vector<std::array<dvec3, 2>>{};
}

void direct_pieces(const SweepOptions& asked, const ProductSource& source, std::size_t look, double cell,
                   const std::function<void(const PlacedScatterer&)>& sink) {
  const Case& c = *source.of_case;
  const RunOptions& run = asked.run;
  const double frequency = c.sweep.frequencies[middle_index(c.sweep.frequencies.size())];
  SolveOptions options{c.tubes, c.edges, c.surfaces, run.work.threads};
  options.progress = progress_of_pieces(run.work.quiet, look, frequency);
  const std::vector<std::string>& wanted = asked.mechanisms;
  const std::vector<std::string> names = piece_names(mechanism_list());
  bool any = false;
  const PieceSink keep_wanted = [&](const ScatteringPiece& piece) {
    if (!wanted.empty() && std::ranges::find(wanted, names[piece.mechanism]) == wanted.end()) return;
    any = any || largest_amplitude(piece.s) > 0.0;
    sink({piece.place, piece.s, piece.mechanism < tube_pieces.size()});
  };
  naming_the_case(c, [&] { scattering_pieces(*source.target, c.sweep, look, frequency, options, cell, keep_wanted, c.ground); });
  if (!wanted.empty() && !any)
    throw InputError(fmt::format("--mechanisms {}: add nothing in look {}; leave the option out, or name others",
                                 fmt::join(wanted, ","), look));
}

void Product::write(const fs::path& folder, const Destination& destination, bool with_netcdf) const {
  if (!destination.one_file()) {
    write_files(folder);
    stop_if_interrupted();
    if (!drawn.empty()) draw_with_python(folder, {drawn}, run.empty() ? folder : run);
  }
  if (destination.one_file() || with_netcdf) write_netcdf(folder / (destination.one_file() ? destination.file : netcdf));
  stop_if_interrupted();
}

void make_product(RunOptions run, Product& product) {
  run.input.file = result_in(run.input.file);
  if (is_case(run.input.file) && !product.from_pieces) return run_case(run, &product);
  product.source = source_without_run(run, product.from_pieces);
  const ProductSource& source = product.source;
  if (attribute_of(source.result, "title").empty()) product.source.result.attributes.emplace_back("title", source.title);
  const fs::path folder_of_input = fs::absolute(run.input.file).parent_path();
  const Destination destination = destination_of(run.output, source.of_case ? folder_of_input / "out" : folder_of_input,
                                                 product.names.tables.front().c_str());
  const ResultNames names = destination.one_file() ? ResultNames{{}, {destination.file}} : product.names;
  check_output(destination.folder, names,
               source.of_case ? input_files(*source.of_case) : std::vector<InputFile>{{"the result", run.input.file}});
  product.run = source.of_case ? run.input.file : folder_of_input;
  product.check();
  const std::string text = product.make();
  if (!run.work.quiet || product.json) fmt::print("{}", text);
  AllOrNothing results(destination.folder);
  const std::vector<std::string> placed = results.place(
      names, [&](const fs::path& folder) { product.write(folder, destination, source.of_case && source.of_case->netcdf); });
  if (run.work.quiet || product.json) return;
  const std::string list = destination.one_file() ? "" : fmt::format(": {}", fmt::join(placed, ", "));
  fmt::print("results            {}{}\n", Destination{results.folder(), destination.file}.text(), list);
}

}  // namespace raytube
