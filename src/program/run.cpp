// raytube run: case -> mesh -> solve -> files.
#include <fmt/ranges.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <set>

#include "case/materials/materials.h"
#include "case/read_case.h"
#include "case/resolved_case.h"
#include "case/target.h"
#include "core/instruction_set.h"
#include "core/text.h"
#include "core/threads.h"
#include "jobs/inputs.h"
#include "jobs/material_report.h"
#include "jobs/memory.h"
#include "jobs/result_warnings.h"
#include "jobs/solvable.h"
#include "jobs/warnings/warnings.h"
#include "output/compare/random_report.h"
#include "output/files/files.h"
#include "output/files/manifest.h"
#include "output/files/sha256.h"
#include "output/files/unlisted_results.h"
#include "output/netcdf/netcdf_file.h"
#include "output/plots/parts_plot.h"
#include "output/plots/plot.h"
#include "output/plots/polar_plot.h"
#include "output/tables/csv.h"
#include "output/tables/stored.h"
#include "output/words/summary.h"
#include "program/commands.h"
#include "program/images.h"
#include "program/unusable_rows.h"
#include "program/work/interrupt.h"
#include "program/work/look_journal.h"
#include "program/work/progress_bar.h"
#include "program/work/results.h"
#include "scene/sampling.h"
#include "solve/random.h"
#include "solve/solve.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// What goes into the tables; by chance, the mean of the random runs.
struct Solved {
  SweepResult result;
  std::optional<RandomResult> by_chance = {};
};

Solved solve_with_progress(const SolvePlan& plan, const Request& request, LookJournal& journal) {
  const double there = static_cast<double>(journal.resumed()) / static_cast<double>(plan.looks.computed.size());
  ProgressBar bar(request.quiet, work_text(plan), there);
  const auto progress = [&](double share) {
    bar.show(share);
    journal.write_now_and_then();
    return !InterruptFlag::raised();
  };
  if (!request.random) return {solve(plan, progress, journal.looks())};
  RandomResult random = solve_with_random_tubes(plan, *request.random, progress);
  return {random.mean, std::move(random)};
}

std::string note_of(const Solved& solved) { return solved.by_chance ? random_note(solved.by_chance->options) : ""; }

// Those beside rcs.csv.
void write_tables(const fs::path& folder, const Case& c, const Solved& solved, bool parts) {
  const auto& [result, by_chance] = solved;
  write_channels_csv(folder / "channels.csv", c.sweep, result);
  stop_if_interrupted();
  if (parts) write_parts_csv(folder / "parts.csv", c.sweep, result);
  if (c.incoherent) write_incoherent_csv(folder / "incoherent.csv", c.sweep, result);
  if (by_chance) write_random_csv(folder / "random.csv", c.sweep, *by_chance);
  stop_if_interrupted();
}

void draw_plots(const fs::path& folder, const Case& c, const SweepResult& result, std::span<const dvec3> outermost, bool parts) {
  std::string trouble = plot_rcs(folder, c.title, c.sweep, result, outermost);
  stop_if_interrupted();
  if (trouble.empty() && parts) trouble = plot_parts(folder, c.title, c.sweep, result, outermost);
  stop_if_interrupted();
  if (!trouble.empty()) warn(trouble);
}

std::uint64_t peak_rss_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

void warn_of_mesh(const Case& c, const std::string& sentence) {
  if (!sentence.empty()) warn(fmt::format("{}: {}", mesh_names(c), sentence));
}

// What of the materials is not seen as it is drawn.
void warn_of_materials(const Case& c, const MeshReport& report, const Target& target, Manifest& manifest) {
  const OverlapNote overlap = overlap_note(c, target);
  for (const std::string& sentence : {duplicates_sentence(report), overlap.sentence}) warn_of_mesh(c, sentence);
  if (overlap.pairs > 0)
    manifest.mesh_notes.emplace_back("pairs of facets of different materials upon one another in one plane, one of which is seen",
                                     static_cast<double>(overlap.pairs));
}

// What every bit of a finished look depends on, beside the number of threads, on which none does.
JournalIdentity identity_of(const Case& c, const Manifest& manifest) {
  JournalIdentity identity{{"version or build of raytube", manifest.program_version + ' ' + sha256_of_file("/proc/self/exe")},
                           {"mesh in target.mesh", fmt::format("{}", fmt::join(manifest.mesh_sha256, " "))},
                           {"list in look.looks_csv", manifest.looks_csv_sha256}};
  for (const auto& [name, sha256] : manifest.table_csv_sha256) identity.emplace_back("table " + name, sha256);
  if (!c.radar.pattern_csv.empty())
    identity.emplace_back("pattern in radar.pattern_csv", sha256_of_file(c.file.parent_path() / c.radar.pattern_csv));
  for (const auto& [key, value] : numerical_keys(c)) identity.emplace_back(key, value);
  return identity;
}

// Where the results go: a folder, or one netCDF file alone in it.
struct Destination {
  fs::path folder;
  std::string file;  // empty: all files

  bool one_file() const { return !file.empty(); }
  std::string text() const { return (one_file() ? folder / file : folder).string(); }
};

Destination destination_of(const Request& request, const Case& c) {
  const fs::path& asked = request.output_folder;
  if (asked.empty()) return {c.file.parent_path() / "out", ""};
  if (std::error_code unreadable; fs::is_directory(asked, unreadable)) return {asked, ""};
  if (lower_case(asked.extension().string()) == ".csv")
    throw InputError(
        fmt::format("-o {}: results are a folder of files, rcs.csv among them, or one netCDF file; write -o DIR or -o {}",
                    asked.string(), fs::path(asked).replace_extension(".nc").string()));
  if (!is_netcdf_name(asked)) return {asked, ""};
  return {fs::absolute(asked).parent_path(), asked.filename().string()};
}

ResultNames names_of_results(const Request& request, const Case& c, const Destination& destination) {
  if (destination.one_file()) return {{}, {destination.file}};
  ResultNames names = image_names(c);
  if (c.plots) names.pictures.insert(names.pictures.end(), {"rcs.png", "rcs.svg"});
  if (c.plots && has_full_circle(c.sweep)) names.pictures.insert(names.pictures.end(), {"rcs_polar.png", "rcs_polar.svg"});
  if (c.plots && request.parts) names.pictures.insert(names.pictures.end(), {"parts.png", "parts.svg"});
  names.tables.emplace_back("channels.csv");
  if (request.parts) names.tables.emplace_back("parts.csv");
  if (c.incoherent) names.tables.emplace_back("incoherent.csv");
  if (request.random) names.tables.emplace_back("random.csv");
  if (c.netcdf) names.tables.emplace_back("rcs.nc");
  names.tables.insert(names.tables.end(), {"rcs.csv", "run.json"});
  return names;
}

// What a run with other wishes may have left, and a page that tells of the results that are replaced. One file replaces nothing
// but itself.
std::vector<std::string> names_of_earlier_results(const Destination& destination) {
  if (destination.one_file()) return {};
  const std::set<std::string> images = names_of_images(destination.folder);
  std::vector<std::string> names(images.begin(), images.end());
  names.insert(names.end(), {"incoherent.csv", "parts.csv", "parts.png", "parts.svg", "random.csv", "rcs.nc", "rcs.png",
                             "rcs.svg", "rcs_polar.png", "rcs_polar.svg", "report.html"});
  return names;
}

// A run from the computation on, into its folder.
class Run {
 public:
  Run(const Request& request, const Case& c, const MeshReport& report, const SolvePlan& plan, const Destination& destination,
      Manifest& manifest)
      : request_(request),
        case_(c),
        report_(report),
        plan_(plan),
        outermost_(outermost_points(plan.target.mesh.vertices)),
        manifest_(manifest),
        destination_(destination),
        folder_(destination.folder),
        journal_(
            folder_.path(), [this] { return identity_of(case_, manifest_); }, [this] { make_again_if_gone(folder_); }) {
    if (request.resume)
      journal_.resume();
    else
      LookJournal::refuse_leftover(folder_.path());  // once more: since the first time the folder was free for others
  }

  /// If it does not come to its end it leaves the finished looks for another one to resume. Throws after its end if there are
  /// rows that must not be used.
  void run(const Stopwatch& total) {
    const InterruptFlag interrupt_flag([this] { return last_words(); });
    warnings_ = warnings_of(case_, plan_, outermost_);
    for (const std::string& sentence : warnings_) warn(sentence);
    bool unusable = false;
    try {
      const Solved solved = solve_with_progress(plan_, request_, journal_);
      journal_.keep_all();
      unusable = warn_of_unusable_rows(solved.result.statistics);
      warn_of_lost_rays(solved.result.statistics);
      write(solved, total);
      if (!request_.quiet) print(solved);
    } catch (const Interrupted&) {
      throw Interrupted(interrupted_sentence());
    } catch (const std::exception&) {
      if (const std::string kept = journal_.keep_all(); !kept.empty()) warn(kept);
      throw;
    }
    if (unusable) throw unusable_rows_in(folder_.path());
  }

 private:
  void warn_of_lost_rays(const Statistics& statistics) const {
    if (statistics.lost_rays > 0) warn(lost_rays_sentence(statistics, case_.metres_per_unit, case_.unit));
  }

  // Once more if somebody removes the folder meanwhile.
  void write(const Solved& solved, const Stopwatch& total) {
    try {
      write_into_folder(solved, total);
    } catch (const Interrupted&) {
      throw;
    } catch (const std::runtime_error&) {
      if (folder_.is_there()) throw;
      write_into_folder(solved, total);
    }
  }

  void write_into_folder(const Solved& solved, const Stopwatch& total) {
    make_again_if_gone(folder_);
    NewResults results(folder_.path());
    complete_manifest(solved);
    write_rcs_csv(results.folder() / "rcs.csv", case_.sweep, solved.result, note_of(solved));
    stop_if_interrupted();
    manifest_.rcs_csv_sha256 = sha256_of_file(results.folder() / "rcs.csv");
    if (case_.netcdf) write_netcdf_of(solved, results.folder());
    if (!destination_.one_file()) write_others(solved, results.folder(), total);
    replace_results(results, folder_.path(), names_of_results(request_, case_, destination_),
                    names_of_earlier_results(destination_), [this] { complete_ = true; });
    journal_.remove();
  }

  void complete_manifest(const Solved& solved) {
    const auto& [result, by_chance] = solved;
    manifest_.warnings = warnings_of_result(warnings_, case_, plan_.target, report_, result.statistics);
    manifest_.statistics = result.statistics;
    manifest_.model_parts = result.model_parts;
    for (ModelPart& part : manifest_.model_parts) part.rows.clear();
    manifest_.looks_resumed = journal_.resumed();
    if (by_chance) manifest_.random = {by_chance->options, by_chance->run_s, by_chance->deterministic.statistics.solve_s};
  }

  void write_netcdf_of(const Solved& solved, const fs::path& folder) const {
    StoredResult result = stored(case_.sweep, solved.result, note_of(solved));
    result.attributes = attributes_of(manifest_);
    write_netcdf(folder / (destination_.one_file() ? destination_.file : "rcs.nc"), result);
    stop_if_interrupted();
  }

  // What comes beside rcs.csv and rcs.nc.
  void write_others(const Solved& solved, const fs::path& folder, const Stopwatch& total) {
    write_tables(folder, case_, solved, request_.parts);
    const double drawing_s = write_images(folder, plan_, case_);
    manifest_.peak_rss_bytes = peak_rss_bytes();
    manifest_.time.total_s = total.seconds() - drawing_s;
    write_manifest(folder / "run.json", manifest_);
    if (case_.plots) draw_plots(folder, case_, solved.result, outermost_, request_.parts);
  }

  void print(const Solved& solved) const {
    if (solved.by_chance) fmt::print("{}", random_text(*solved.by_chance));
    fmt::print("{}", summary_text(solved.result, facts()));
  }

  RunFacts facts() const {
    return {case_.tubes,
            !case_.sweep.materials.empty(),
            request_.random.has_value(),
            manifest_.threads,
            manifest_.looks_resumed,
            manifest_.warnings.size(),
            Destination{folder_.path(), destination_.file}.text()};
  }

  std::string interrupted_sentence() {
    const std::string kept = journal_.keep_all();
    return kept.empty() ? Interrupted().what() : "interrupted; " + kept;
  }

  std::optional<std::string> last_words() {
    if (complete_) return {};
    std::string sentence = interrupted_sentence();
    folder_.abandon();
    return sentence;
  }

  const Request& request_;
  const Case& case_;
  const MeshReport& report_;
  const SolvePlan& plan_;
  std::vector<std::string> warnings_;  // of case and plan
  std::vector<dvec3> outermost_;       // points of the target as wide as all of it
  Manifest& manifest_;
  const Destination& destination_;
  OutputFolder folder_;
  LookJournal journal_;
  std::atomic<bool> complete_ = false;
};

// What random tubes cannot be asked for.
void refuse_random_tubes(const Case& c) {
  if (!c.image_looks.empty())
    throw InputError(
        c.file.string() +
        ": output.image_look: an image adds up to the deterministic S, not to the mean of random tubes; leave out one");
  if (c.incoherent)
    throw InputError(c.file.string() +
                     ": output.incoherent: random tubes do not add up what roughness scatters; remove it, or --launch random");
}

// The case with what one netCDF file alone means for it.
Case case_for(const Destination& destination, const Request& request, Case c) {
  if (!destination.one_file()) return c;
  if (request.random)
    throw InputError(
        fmt::format("-o {}: one netCDF file has no place for the spread of random tubes; give a folder, or leave out "
                    "--launch random",
                    request.output_folder.string()));
  if (!c.image_looks.empty())
    warn(fmt::format("{}: output.image_look has no effect with -o {}: give a folder for images", c.file.string(),
                     request.output_folder.string()));
  c.image_looks.clear();
  c.plots = false;
  c.netcdf = true;
  return c;
}

}  // namespace

void run_command(const Request& request) {
  const Stopwatch total;
  const Case read = read_case(request.case_file, request.overrides);
  const Destination destination = destination_of(request, read);
  const Case c = case_for(destination, request, read);
  check_output(destination.folder, names_of_results(request, c, destination), input_files(c));
  if (!request.resume) LookJournal::refuse_leftover(destination.folder);
  if (request.random) refuse_random_tubes(c);
  LoadedMesh loaded = load_target(c);
  warn_of_mesh(c, free_forms_sentence(loaded.report));
  Manifest manifest = described_inputs(read, loaded.report, sha256_of_meshes(c, loaded.report));
  manifest.time.read_s = total.seconds();
  manifest.threads = request.threads > 0 ? request.threads : all_threads();
  std::optional<Target> built;
  run_on_threads(manifest.threads, [&] { built.emplace(std::move(loaded.mesh), c.wedges); });
  const Target& target = *built;
  const SolvePlan plan = plan_of_case(target, c, manifest.threads, request.parts || request.random.has_value());
  warn_of_materials(c, loaded.report, target, manifest);
  manifest.time.build_s = total.seconds() - manifest.time.read_s - plan.seconds;  // planning is part of solving
  manifest.embree_instruction_set = name_of(allowed_instruction_set());
  manifest.own_instruction_set = name_of(std::max(allowed_instruction_set(), InstructionSet::avx2));
  check_memory(plan, c, request.random ? &*request.random : nullptr);
  if (request.random) check_random_tubes(plan, *request.random);
  Run(request, c, loaded.report, plan, destination, manifest).run(total);
}

}  // namespace raytube
