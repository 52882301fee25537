#include "program/products.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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
#include "jobs/recorded_run.h"
#include "jobs/solvable.h"
#include "output/compare/density_results.h"
#include "output/files/sha256.h"
#include "output/netcdf/netcdf_file.h"
#include "output/tables/stored.h"
#include "program/python.h"
#include "program/solve_warnings.h"
#include "program/work/destination.h"
#include "program/work/interrupt.h"
#include "program/work/progress_bar.h"
#include "solve/pieces.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

bool is_case(const fs::path& file) { return lower_case(file.extension().string()) == ".toml"; }

// Of a case that is not solved, so that nothing is known of a result.
std::vector<std::pair<std::string, std::string>> attributes_without_result(const Manifest& manifest) {
  auto attributes = attributes_of(manifest);
  std::erase_if(attributes, [](const auto& each) {
    return each.first == "counts" || each.first == "warnings" || each.first == "model_uncertainty";
  });
  return attributes;
}

// For pieces. What a run of the case is refused for they are refused for, too.
ProductSource source_of_pieces(const Request& request) {
  const Case c = read_case(request.result, request.overrides);
  LoadedMesh loaded = load_target(c, true);
  warn_of_reading(c, loaded.report);
  const Manifest manifest = described_inputs(c, loaded.report, sha256_of_meshes(c, loaded.report));
  std::shared_ptr<const Target> target;
  run_on_threads(request.threads, [&] { target = std::make_shared<const Target>(std::move(loaded.mesh), c.wedges); });
  plan_of_case(*target, c, request.threads, false);
  ProductSource source = source_of(c, std::move(target));
  source.result.attributes = attributes_without_result(manifest);
  return source;
}

// The target of a result, if its meshes are where its run had them, and the same.
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

// Of the table that a result is, or is a copy of.
std::string rcs_csv_sha256_of(const fs::path& file, const StoredResult& result) {
  if (!is_netcdf_name(file)) return sha256_of_file(file);
  return attribute_of(result, "rcs_csv_sha256");
}

// All that scatters in one look of the case, at the frequency in the middle of its list.
void pieces_of_look(const Request& request, const ProductSource& source, std::size_t look, double cell, const PieceSink& sink) {
  const Case& c = *source.of_case;
  SolveOptions options{c.tubes, c.edges, c.surfaces, request.threads};
  const double frequency = c.sweep.frequencies[middle_index(c.sweep.frequencies.size())];
  options.progress = progress_of_pieces(request, look, frequency);
  naming_the_case(c, [&] { scattering_pieces(*source.target, c.sweep, look, frequency, options, cell, sink, c.ground); });
}

// A result that is there, or pieces.
ProductSource product_source(const Request& request) {
  const std::string file = request.result.string();
  if (request.ranks)
    throw InputError(fmt::format("{}: nothing is solved that several processes could share; start one alone", file));
  if (request.resume)
    throw InputError(fmt::format("--resume: nothing is solved of {} that could have been stopped; leave it out", file));
  if (is_case(request.result)) return source_of_pieces(request);
  if (request.product.direct)
    throw InputError(fmt::format("{} is no case (.toml); only a case says where its S comes from", file));
  if (!request.overrides.empty())
    throw InputError(fmt::format("--set {}: means nothing for a result that is there; leave it out, or give a case",
                                 request.overrides.front()));
  return stored_source(request.result);
}

std::vector<InputFile> inputs_of(const Request& request, const ProductSource& source) {
  if (source.of_case) return input_files(*source.of_case);
  return {{"the result", request.result}};
}

void print_places(const ResultNames& names, const NewResults& results, const Destination& destination) {
  if (destination.one_file()) return fmt::print("results            {}\n", destination.text());
  std::vector<std::string> written = names.tables;
  written.insert(written.end(), names.pictures.begin(), names.pictures.end());
  std::erase_if(written, [&](const std::string& name) { return !results.has_placed(name); });
  fmt::print("results            {}: {}\n", destination.text(), fmt::join(written, ", "));
}

}  // namespace

ProductSource source_of(const Case& c, std::shared_ptr<const Target> target) {
  return {c, c.file.string(), c.title, stored_sweep(c.sweep), std::move(target)};
}

ProductSource stored_source(const fs::path& file) {
  ProductSource source{.of_case = {}, .name = file.string(), .title = file.filename().string(), .result = {}, .target = {}};
  source.result = is_netcdf_name(file) ? read_netcdf(file) : read_rcs_csv(file);
  if (const std::string title = attribute_of(source.result, "title"); !title.empty()) source.title = title;
  std::ifstream in(fs::absolute(file).parent_path() / "run.json");
  const Json run = json_of(std::string{std::istreambuf_iterator<char>(in), {}});
  if (run.is_discarded() || text_at(run, "rcs_csv_sha256") != rcs_csv_sha256_of(file, source.result)) return source;
  if (const Json* const resolved = find(run, "case"); resolved && !text_at(*resolved, "title").empty())
    source.title = text_at(*resolved, "title");
  source.target = target_of(run);
  return source;
}

std::function<bool(double)> progress_of_pieces(const Request& request, std::size_t look, double frequency) {
  return [&request, look, frequency, bar = std::shared_ptr<ProgressBar>()](double share) mutable {
    if (!bar)
      bar = std::make_shared<ProgressBar>(request.quiet,
                                          fmt::format("taking look {} at {:g} GHz to pieces", look, frequency * 1e-9));
    bar->show(share);
    return !InterruptFlag::raised();
  };
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
    const std::string name = name_of(piece.mechanism);
    if (!wanted.empty() && std::ranges::find(wanted, name) == wanted.end()) return;
    any = any || largest_amplitude(piece.s) > 0.0;
    sink({piece.place, piece.s, piece.mechanism <= ScatteringMechanism::later_bounces});
  });
  if (!wanted.empty() && !any)
    throw InputError(fmt::format("--mechanisms {}: add nothing in look {}; leave the option out, or name others",
                                 fmt::join(wanted, ","), look));
}

void Product::write(const fs::path& folder, const Destination& destination, bool with_netcdf) const {
  if (!destination.one_file()) {
    write_files(folder);
    stop_if_interrupted();
    const std::string trouble = draw_with_python(folder, {drawn}, run.empty() ? folder : run);
    if (!trouble.empty()) warn(trouble);
  }
  if (destination.one_file() || with_netcdf) write_netcdf(folder / (destination.one_file() ? destination.file : netcdf));
  stop_if_interrupted();
}

std::vector<double> lengths_of_size(const std::vector<std::string>& words, fs::path& input) {
  constexpr double least = 1e-6, most = 1e6;  // [m]
  std::vector<double> lengths;
  for (const std::string& word : words) {
    const std::size_t before = lengths.size();
    for (std::size_t at = 0, end = 0; at <= word.size(); at = end + 1) {
      end = std::min(word.find_first_of("x,", at), word.size());
      const std::optional<double> length = parsed_number(word.substr(at, end - at));
      if (length && *length >= least && *length <= most) {
        lengths.push_back(*length);
        continue;
      }
      if (before < 2 || !input.empty() || &word != &words.back())
        throw InputError(
            fmt::format("--size: needs two lengths in metres, or three of an image in space, such as 8x8 (found {})", word));
      lengths.resize(before);
      input = word;
      break;
    }
  }
  if (!words.empty() && (lengths.size() < 2 || lengths.size() > 3))
    throw InputError(
        fmt::format("--size: needs two lengths in metres, or three of an image in space (found {})", fmt::join(words, " ")));
  return lengths;
}

void make_product(const Request& request, Product& product) {
  Request run = request;
  run.case_file = run.result = result_in(request.result);
  if (is_case(run.result) && !request.product.direct) return run_case(run, &product);
  product.source = product_source(run);
  const ProductSource& source = product.source;
  if (attribute_of(source.result, "title").empty()) product.source.result.attributes.emplace_back("title", source.title);
  const fs::path folder_of_input = fs::absolute(run.result).parent_path();
  const Destination destination = destination_of(
      request.output_folder, source.of_case ? folder_of_input / "out" : folder_of_input, product.names.tables.front().c_str());
  const ResultNames names = destination.one_file() ? ResultNames{{}, {destination.file}} : product.names;
  check_output(destination.folder, names, inputs_of(run, source));
  product.run = source.of_case ? run.result : folder_of_input;
  product.check();
  const std::string text = product.make();
  if (!request.quiet || request.json) fmt::print("{}", text);
  const OutputFolder folder(destination.folder);
  AllOrNothing ending(folder);
  const InterruptFlag interrupt_flag([&ending] { return ending.last_words(); });
  NewResults results(folder.path());
  product.write(results.folder(), destination, source.of_case && source.of_case->netcdf);
  replace_results(results, folder.path(), names, {}, [&ending] { ending.complete(); });
  if (!request.quiet && !request.json) print_places(names, results, Destination{folder.path(), destination.file});
}

}  // namespace raytube
