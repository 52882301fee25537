#include "program/run/run_results.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <atomic>
#include <optional>

#include "core/text.h"
#include "jobs/result_warnings.h"
#include "jobs/warnings/warnings.h"
#include "output/compare/random_report.h"
#include "output/files/files.h"
#include "output/files/sha256.h"
#include "output/netcdf/netcdf_file.h"
#include "output/plots/parts_plot.h"
#include "output/plots/plot.h"
#include "output/tables/csv.h"
#include "output/tables/stored.h"
#include "output/words/summary.h"
#include "program/helping.h"
#include "program/images.h"
#include "program/solve_warnings.h"
#include "program/work/interrupt.h"
#include "program/work/look_journal.h"
#include "program/work/progress_bar.h"
#include "ranks/ranks.h"
#include "scene/sampling.h"
#include "solve/random.h"
#include "solve/solve.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

// What goes into the tables; by chance, the mean of the random runs.
struct Solved {
  SweepResult result;
  std::optional<RandomResult> by_chance = {};
};

Solved solve_with_progress(const SolvePlan& plan, const Request& request, LookJournal& journal, const KeptLooks& kept,
                           std::size_t known) {
  ProgressBar bar(request.quiet, work_text(plan), static_cast<double>(known) / static_cast<double>(plan.looks.computed.size()));
  const auto progress = [&](double share) {
    bar.show(share);
    journal.write_now_and_then();
    return !InterruptFlag::raised();
  };
  if (!request.random) return {solve(plan, progress, kept, team_of(request))};
  RandomResult random = solve_with_random_tubes(plan, *request.random, progress, team_of(request));
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
  if (c.power) write_power_csv(folder / "power.csv", c.sweep, *c.radar.link, result);
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

// A run from the computation on, into its folder.
class Run {
 public:
  Run(const Request& request, PreparedRun& prepared, const Destination& destination, const MergedLooks* merged)
      : request_(request),
        case_(prepared.c),
        report_(prepared.report),
        plan_(*prepared.plan),
        outermost_(outermost_points(plan_.target.mesh.vertices)),
        manifest_(prepared.manifest),
        destination_(destination),
        merged_(merged),
        folder_(destination.folder),
        journal_(
            LookJournal::file_in(folder_.path()), [this] { return identity_of(case_, manifest_); },
            [this] { make_again_if_gone(folder_); }) {
    if (request.resume && !journal_.resume())
      warn(fmt::format("nothing to resume in {}: the run starts afresh", folder_.path().string()));
    if (!request.resume)
      LookJournal::refuse_leftover(journal_.file());  // once more: since the first time the folder was free for others
  }

  /// If it does not come to its end it leaves the finished looks for another one to resume. Throws after its end if there are
  /// rows that must not be used.
  void run(const Stopwatch& total) {
    const InterruptFlag interrupt_flag([this] { return last_words(); });
    warnings_ = warnings_of(case_, plan_, outermost_);
    for (const std::string& sentence : warnings_) warn(sentence);
    bool unusable = false;
    try {
      const Solved solved = solve_with_progress(plan_, request_, journal_, merged_ ? merged_->looks : journal_.looks(), known());
      if (request_.ranks) request_.ranks->end();
      journal_.keep_all();
      unusable = warn_of_unusable_rows(solved.result.statistics);
      warn_of_lost_rays(case_, solved.result.statistics);
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
  // Looks that need not be computed.
  std::size_t known() const { return merged_ ? merged_->count : journal_.resumed(); }

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
    add_result(manifest_, result, warnings_of_result(warnings_, case_, plan_.target, report_, result.statistics));
    manifest_.looks_resumed = known();
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
  const MergedLooks* merged_;
  OutputFolder folder_;
  LookJournal journal_;
  std::atomic<bool> complete_ = false;
};

}  // namespace

void run_into_folder(const Request& request, PreparedRun& prepared, const Destination& destination, const MergedLooks* merged,
                     const Stopwatch& total) {
  Run(request, prepared, destination, merged).run(total);
}

}  // namespace raytube
