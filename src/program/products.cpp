#include "program/products.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "case/read_case.h"
#include "case/target.h"
#include "core/error.h"
#include "core/json.h"
#include "core/text.h"
#include "core/threads.h"
#include "jobs/imaged_target.h"
#include "jobs/inputs.h"
#include "jobs/memory.h"
#include "jobs/result_warnings.h"
#include "jobs/solvable.h"
#include "jobs/warnings/warnings.h"
#include "output/files/sha256.h"
#include "output/netcdf/netcdf_file.h"
#include "output/tables/stored.h"
#include "program/helping.h"
#include "program/solve_warnings.h"
#include "program/work/destination.h"
#include "program/work/interrupt.h"
#include "program/work/progress_bar.h"
#include "ranks/ranks.h"
#include "scene/sampling.h"
#include "solve/pieces.h"
#include "solve/solve.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr const char* solved_result = "rcs.nc";

bool is_case(const fs::path& file) { return lower_case(file.extension().string()) == ".toml"; }

// Of a case, unless its pieces are enough.
bool is_solved_first(const Request& request) { return is_case(request.result) && !request.product.direct; }

SweepResult solved(const Request& request, const SolvePlan& plan) {
  ProgressBar bar(request.quiet, work_text(plan));
  const auto progress = [&](double share) {
    bar.show(share);
    return !InterruptFlag::raised();
  };
  SweepResult result = solve(plan, progress, {}, team_of(request));
  if (request.ranks) request.ranks->end();
  return result;
}

// What run says before and after it, too.
void solve_into(ProductSource& source, const Request& request, const SolvePlan& plan, const MeshReport& report,
                Manifest& manifest) {
  const Case& c = *source.of_case;
  warn_of_materials(c, report, plan.target, manifest);
  const std::vector<std::string> warnings = warnings_of(c, plan, outermost_points(plan.target.mesh.vertices));
  for (const std::string& sentence : warnings) warn(sentence);
  check_memory(plan, c, nullptr);
  const SweepResult result = naming_the_case(c, [&] { return solved(request, plan); });
  source.unusable_rows = warn_of_unusable_rows(result.statistics);
  warn_of_lost_rays(c, result.statistics);
  source.result = stored(c.sweep, result);
  add_result(manifest, result, warnings_of_result(warnings, c, plan.target, report, result.statistics));
  source.result.attributes = attributes_of(manifest);
}

// Of a case that is not solved, so that nothing is known of a result.
std::vector<std::pair<std::string, std::string>> attributes_without_result(const Manifest& manifest) {
  auto attributes = attributes_of(manifest);
  std::erase_if(attributes, [](const auto& each) {
    return each.first == "counts" || each.first == "warnings" || each.first == "model_uncertainty";
  });
  return attributes;
}

ProductSource source_of_case(const Request& request, const SweepCheck& check) {
  const Case c = read_case(request.result, request.overrides);
  LoadedMesh loaded = load_target(c, request.product.direct);
  if (is_solved_first(request)) share_work(request, c, loaded.mesh);
  warn_of_reading(c, loaded.report);
  const int threads = request.threads > 0 ? request.threads : all_threads();
  ProductSource source{.of_case = c, .name = c.file.string(), .title = c.title, .result = stored_sweep(c.sweep), .target = {}};
  Manifest manifest = described_inputs(c, loaded.report, sha256_of_meshes(c, loaded.report));
  run_on_threads(threads, [&] { source.target = std::make_unique<const Target>(std::move(loaded.mesh), c.wedges); });
  const SolvePlan plan = plan_of_case(*source.target, c, threads, false);
  check(source);
  if (is_solved_first(request))
    solve_into(source, request, plan, loaded.report, manifest);
  else
    source.result.attributes = attributes_without_result(manifest);
  return source;
}

std::string text_of(const JsonValue& json, const char* name) {
  const JsonValue* value = json.find(name);
  return value ? value->text : "";
}

// A value of JSON in the syntax of TOML, which differs for tables alone: none of these sections holds one.
void add_settings(const JsonValue& resolved, const char* section, std::vector<std::string>& settings) {
  const JsonValue* const keys = resolved.find(section);
  for (std::size_t i = 0; keys && i < keys->names.size(); ++i)
    settings.push_back(fmt::format("{}.{}={}", section, keys->names[i], json_text(keys->items[i], -1)));
}

// Of one mesh file a text, of several a list.
std::vector<std::string> mesh_hashes(const JsonValue& run) {
  const JsonValue* const mesh = run.find("mesh");
  const JsonValue* const sha256 = mesh ? mesh->find("sha256") : nullptr;
  if (!sha256) return {};
  if (sha256->kind == JsonValue::Kind::text) return {sha256->text};
  std::vector<std::string> hashes;
  for (const JsonValue& hash : sha256->items) hashes.push_back(hash.text);
  return hashes;
}

// The target of a result, if its meshes are where its run had them, and the same.
std::unique_ptr<const Target> target_of(const JsonValue& run) {
  try {
    const Case c = case_of_run(run);
    LoadedMesh loaded = load_target(c);
    if (mesh_hashes(run) != sha256_of_meshes(c, loaded.report)) return {};
    return std::make_unique<const Target>(std::move(loaded.mesh), c.wedges);
  } catch (const InputError&) {
    return {};
  }
}

// Of the table that a result is, or is a copy of.
std::string rcs_csv_sha256_of(const fs::path& file, const StoredResult& result) {
  if (!is_netcdf_name(file)) return sha256_of_file(file);
  const auto found = std::ranges::find(result.attributes, "rcs_csv_sha256", &std::pair<std::string, std::string>::first);
  return found == result.attributes.end() ? "" : found->second;
}

ProductSource stored_result(const fs::path& file) {
  ProductSource source{.of_case = {}, .name = file.string(), .title = file.filename().string(), .result = {}, .target = {}};
  source.result = is_netcdf_name(file) ? read_netcdf(file) : read_rcs_csv(file);
  for (const auto& [name, text] : source.result.attributes)
    if (name == "title") source.title = text;
  const std::optional<JsonValue> run = run_of(file);
  if (!run || text_of(*run, "rcs_csv_sha256") != rcs_csv_sha256_of(file, source.result)) return source;
  if (const JsonValue* const resolved = run->find("case"); resolved && !text_of(*resolved, "title").empty())
    source.title = text_of(*resolved, "title");
  source.target = target_of(*run);
  return source;
}

// All that scatters in one look of the case, at the frequency in the middle of its list.
void pieces_of_look(const Request& request, const ProductSource& source, std::size_t look, double cell, const PieceSink& sink) {
  const Case& c = *source.of_case;
  SolveOptions options{c.tubes, c.edges, c.surfaces, request.threads};
  options.progress = [](double) { return !InterruptFlag::raised(); };
  const double frequency = c.sweep.frequencies[middle_index(c.sweep.frequencies.size())];
  naming_the_case(c, [&] { scattering_pieces(*source.target, c.sweep, look, frequency, options, cell, sink, c.ground); });
}

Destination destination_of_products(const Request& request, const ProductNames& names) {
  const fs::path folder = fs::absolute(request.result).parent_path();
  return destination_of(request.output_folder, is_case(request.result) ? folder / "out" : folder,
                        names.files.tables.front().c_str());
}

bool wants_netcdf(const ProductSource& source) { return source.of_case && source.of_case->netcdf; }

ResultNames all_names(const Request& request, const ProductSource& source, const ProductNames& names) {
  if (const Destination destination = destination_of_products(request, names); destination.one_file())
    return {{}, {destination.file}};
  ResultNames all = names.files;
  if (wants_netcdf(source)) all.tables.push_back(names.netcdf);
  if (is_solved_first(request)) all.tables.insert(all.tables.begin(), solved_result);
  return all;
}

std::vector<InputFile> inputs_of(const Request& request, const ProductSource& source) {
  if (source.of_case) return input_files(*source.of_case);
  return {{"the result", request.result}};
}

void write_folder(const Request& request, const ProductSource& source, const ProductNames& names, const ProductWriter& write,
                  const fs::path& folder) {
  write.files(folder);
  if (wants_netcdf(source)) write.netcdf(folder / names.netcdf);
  if (is_solved_first(request)) write_netcdf(folder / solved_result, source.result);
}

void print_places(const ResultNames& names, const NewResults& results, const Destination& destination) {
  if (destination.one_file()) return fmt::print("results            {}\n", destination.text());
  std::vector<std::string> written = names.tables;
  written.insert(written.end(), names.pictures.begin(), names.pictures.end());
  std::erase_if(written, [&](const std::string& name) { return !results.has_placed(name); });
  fmt::print("results            {}: {}\n", destination.text(), fmt::join(written, ", "));
}

}  // namespace

std::optional<JsonValue> run_of(const fs::path& result) {
  std::ifstream in(fs::absolute(result).parent_path() / "run.json");
  return parsed_json({std::istreambuf_iterator<char>(in), {}});
}

Case case_of_run(const JsonValue& run) {
  std::vector<std::string> settings;
  if (const JsonValue* const resolved = run.find("case")) {
    if (const JsonValue* target = resolved->find("target"))
      for (const char* key : {"mesh", "unit"})
        if (const JsonValue* value = target->find(key))
          settings.push_back(fmt::format("target.{}={}", key, json_text(*value, -1)));
    for (const char* section : {"frequency", "look", "tubes", "accuracy", "edges", "surfaces"})
      add_settings(*resolved, section, settings);
  }
  return read_case(text_of(run, "case_file"), settings);
}

std::vector<dvec3> ProductSource::outermost() const { return target ? outermost_of(*target) : std::vector<dvec3>{}; }

std::vector<std::array<dvec3, 2>> ProductSource::lines() const {
  return target ? lines_of(*target) : std::vector<std::array<dvec3, 2>>{};
}

void direct_pieces(const Request& request, const ProductSource& source, std::size_t look, double cell,
                   const std::function<void(const PlacedScatterer&)>& sink) {
  const std::vector<std::string>& wanted = request.product.mechanisms;
  bool any = false;
  pieces_of_look(request, source, look, cell, [&](const ScatteringPiece& piece) {
    const std::string name = scattering_mechanisms[static_cast<std::size_t>(piece.mechanism)];
    if (!wanted.empty() && std::ranges::find(wanted, name) == wanted.end()) return;
    any = any || largest_amplitude(piece.s) > 0.0;
    sink({piece.place, piece.s, piece.mechanism <= ScatteringMechanism::later_bounces});
  });
  if (!wanted.empty() && !any)
    throw InputError(fmt::format("--mechanisms {}: add nothing in look {}; leave the option out, or name others",
                                 fmt::join(wanted, ","), look));
}

ProductSource product_source(const Request& request, const SweepCheck& check) {
  if (request.ranks && !is_solved_first(request))
    throw InputError(
        fmt::format("{}: nothing is solved that several processes could share; start one alone", request.result.string()));
  if (is_case(request.result)) return source_of_case(request, check);
  if (request.product.direct)
    throw InputError(fmt::format("{} is no case (.toml); only a case says where its S comes from", request.result.string()));
  if (!request.overrides.empty())
    throw InputError(fmt::format("--set {}: means nothing for a result that is there; leave it out, or give a case",
                                 request.overrides.front()));
  ProductSource source = stored_result(request.result);
  check(source);
  return source;
}

void check_products(const Request& request, const ProductSource& source, const ProductNames& names) {
  check_output(destination_of_products(request, names).folder, all_names(request, source, names), inputs_of(request, source));
}

void write_products(const Request& request, const ProductSource& source, const ProductNames& names, const ProductWriter& write) {
  const Destination destination = destination_of_products(request, names);
  const OutputFolder folder(destination.folder);
  AllOrNothing ending(folder);
  const InterruptFlag interrupt_flag([&ending] { return ending.last_words(); });
  NewResults results(folder.path());
  if (destination.one_file())
    write.netcdf(results.folder() / destination.file);
  else
    write_folder(request, source, names, write, results.folder());
  stop_if_interrupted();
  const ResultNames all = all_names(request, source, names);
  const std::vector<std::string> leftovers =
      destination.one_file() ? std::vector<std::string>{} : std::vector<std::string>{names.netcdf};
  replace_results(results, folder.path(), all, leftovers, [&ending] { ending.complete(); });
  if (!request.quiet) print_places(all, results, Destination{folder.path(), destination.file});
  if (source.unusable_rows) throw unusable_rows_in(folder.path());
}

}  // namespace raytube
