#include "program/run/run_results.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <optional>

#include "core/text.h"
#include "output/compare/random_report.h"
#include "output/files/files.h"
#include "output/files/sha256.h"
#include "output/netcdf/netcdf_file.h"
#include "output/picture/rcs_picture.h"
#include "output/tables/csv.h"
#include "output/tables/stored.h"
#include "output/words/summary.h"
#include "program/helping.h"
#include "program/images.h"
#include "program/python.h"
#include "program/solve_warnings.h"
#include "program/work/interrupt.h"
#include "program/work/look_journal.h"
#include "program/work/progress_bar.h"
#include "ranks/ranks.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

std::string note_of(const SolvedCase& solved) { return solved.by_chance ? random_note(solved.by_chance->options) : ""; }

// Those beside rcs.csv.
void write_tables(const fs::path& folder, const Case& c, const SolvedCase& solved, bool parts) {
  const auto& [result, by_chance] = solved;
  write_channels_csv(folder / "channels.csv", c.sweep, result);
  stop_if_interrupted();
  if (parts) write_parts_csv(folder / "parts.csv", c.sweep, result);
  if (c.incoherent) write_incoherent_csv(folder / "incoherent.csv", c.sweep, result);
  if (c.power) write_power_csv(folder / "power.csv", c.sweep, *c.radar.link, result);
  if (by_chance) write_random_csv(folder / "random.csv", c.sweep, *by_chance);
  stop_if_interrupted();
}

// The plain picture of the result, and by the Python package those of the tables that only some runs have.
void draw_pictures(const fs::path& folder, const Case& c, const SweepResult& result, std::span<const dvec3> outermost,
                   bool parts) {
  if (const std::string trouble = draw_rcs(folder, c.title, c.sweep, result, outermost); !trouble.empty()) warn(trouble);
  stop_if_interrupted();
  std::vector<std::string> tables = image_tables(c);
  if (parts) tables.emplace_back("parts.csv");
  if (tables.empty()) return;
  if (const std::string trouble = draw_with_python(folder, tables, folder); !trouble.empty()) warn(trouble);
  stop_if_interrupted();
}

std::uint64_t peak_rss_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

// A run from the computation on, into its folder.
class Run {
 public:
  Run(const Request& request, PreparedRun& prepared, const Destination& destination, const MergedLooks* merged, Product* product)
      : request_(request),
        case_(prepared.c),
        planned_(*prepared.planned),
        plan_(planned_.plan),
        outermost_(prepared.outermost),
        manifest_(prepared.manifest),
        destination_(destination),
        merged_(merged),
        product_(product),
        folder_(destination.folder),
        journal_(
            LookJournal::file_in(folder_.path()), [this] { return identity_of(case_, manifest_); },
            [this] { folder_.require_there(); }) {
    if (request.resume && !journal_.resume())
      warn(fmt::format("nothing to resume in {}: the run starts from the beginning", folder_.path().string()));
    if (!request.resume)
      LookJournal::refuse_leftover(journal_.file());  // once more: since the first time the folder was free for others
  }

  /// If it does not come to its end it leaves the finished looks for another one to resume. Throws after its end if there are
  /// rows that must not be used.
  void run(const Stopwatch& total) {
    const InterruptFlag interrupt_flag([this] { return last_words(); });
    for (const std::string& sentence : planned_.warnings) warn(sentence);
    bool unusable = false;
    try {
      const SolvedCase solved = solve();
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
      folder_.require_there();
      throw;
    }
    if (unusable) throw unusable_rows_in(folder_.path());
  }

 private:
  // Looks that need not be computed.
  std::size_t known() const { return merged_ ? merged_->count : journal_.resumed(); }

  SolvedCase solve() {
    const double all = static_cast<double>(plan_.looks.computed.size());
    ProgressBar bar(request_.quiet, work_text(plan_), static_cast<double>(known()) / all);
    const auto progress = [&](double share) {
      bar.show(share);
      journal_.write_now_and_then();
      return !InterruptFlag::raised();
    };
    manifest_.looks_resumed = known();
    return solve_case(planned_, manifest_, progress, merged_ ? merged_->looks : journal_.looks(), team_of(request_));
  }

  void write(const SolvedCase& solved, const Stopwatch& total) {
    folder_.require_there();
    NewResults results(folder_.path());
    write_rcs_csv(results.folder() / "rcs.csv", case_.sweep, solved.result, note_of(solved));
    stop_if_interrupted();
    manifest_.rcs_csv_sha256 = sha256_of_file(results.folder() / "rcs.csv");
    if (case_.netcdf && !(product_ && destination_.one_file())) write_netcdf_of(solved, results.folder());
    if (!destination_.one_file()) write_others(solved, results.folder(), total);
    if (product_) {
      product_->source.result = stored_result(solved);
      product_text_ = product_->make();
      product_->write(results.folder(), destination_, case_.netcdf);
    }
    replace_results(results, folder_.path(),
                    names_of_results(request_, case_, destination_, product_ ? product_->names : ResultNames{}),
                    names_of_earlier_results(destination_), [this] { complete_ = true; });
    journal_.remove();
  }

  StoredResult stored_result(const SolvedCase& solved) const {
    StoredResult result = stored(case_.sweep, solved.result, note_of(solved));
    result.attributes = attributes_of(manifest_);
    return result;
  }

  void write_netcdf_of(const SolvedCase& solved, const fs::path& folder) const {
    write_netcdf(folder / (destination_.one_file() ? destination_.file : "rcs.nc"), stored_result(solved));
    stop_if_interrupted();
  }

  // What comes beside rcs.csv and rcs.nc.
  void write_others(const SolvedCase& solved, const fs::path& folder, const Stopwatch& total) {
    write_tables(folder, case_, solved, request_.parts);
    write_images(folder, plan_, case_);
    manifest_.peak_rss_bytes = peak_rss_bytes();
    manifest_.time.total_s = total.seconds();
    write_manifest(folder / "run.json", manifest_);
    if (case_.plots) draw_pictures(folder, case_, solved.result, outermost_, request_.parts);
  }

  void print(const SolvedCase& solved) const {
    if (solved.by_chance) fmt::print("{}", random_text(*solved.by_chance));
    fmt::print("{}", summary_text(solved.result, facts()));
    fmt::print("{}", product_text_);
  }

  RunFacts facts() const {
    return {size_text(size_of(plan_.target.mesh.vertices), std::ranges::max(case_.sweep.frequencies)),
            case_.tubes,
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
  const PlannedCase& planned_;
  const SolvePlan& plan_;
  const std::vector<dvec3>& outermost_;
  Manifest& manifest_;
  const Destination& destination_;
  const MergedLooks* merged_;
  Product* product_;
  std::string product_text_;
  OutputFolder folder_;
  LookJournal journal_;
  std::atomic<bool> complete_ = false;
};

}  // namespace

void run_into_folder(const Request& request, PreparedRun& prepared, const Destination& destination, const MergedLooks* merged,
                     const Stopwatch& total, Product* product) {
  Run(request, prepared, destination, merged, product).run(total);
}

}  // namespace raytube
