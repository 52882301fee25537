#include "program/run/run_results.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <optional>

#include "output/files/files.h"
#include "output/files/sha256.h"
#include "output/netcdf/netcdf_file.h"
#include "output/picture/rcs_picture.h"
#include "output/tables/csv.h"
#include "output/tables/stored.h"
#include "output/words/plural.h"
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

SweepResult solve(const RunTask& task, LookJournal& journal) {
  const SolvePlan& plan = task.prepared.planned->plan;
  Manifest& manifest = task.prepared.manifest;
  manifest.looks_resumed = task.merged ? task.merged->count : journal.resumed();
  const std::size_t looks = task.prepared.planned->items();
  const std::string work = fmt::format("solving {} at {} on {}", count_text(looks, task.prepared.planned->pulse_by_pulse() ? "time" : "look"),
                                       count_text(plan.sweep.frequencies.size(), "frequency", "frequencies"),
                                       count_text(static_cast<std::uint64_t>(manifest.threads), "thread"));
  ProgressBar bar(task.asked.work.quiet, work, static_cast<double>(manifest.looks_resumed) / static_cast<double>(looks));
  const auto progress = [&](double share) {
    journal.write_now_and_then();
    return bar.show(share);
  };
  return solve_case(*task.prepared.planned, manifest, progress, task.merged ? task.merged->looks : journal.looks(),
                    team_of(task.asked.work));
}

std::uint64_t peak_rss_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

// Writes everything that a folder holds beside rcs.csv and rcs.nc.
void write_others(const RunTask& task, const SweepResult& result, const fs::path& folder) {
  const Case& c = task.prepared.c;
  write_channels_csv(folder / "channels.csv", c.sweep, result);
  stop_if_interrupted();
  if (task.asked.parts) write_parts_csv(folder / "parts.csv", c.sweep, result);
  if (c.incoherent) write_incoherent_csv(folder / "incoherent.csv", c.sweep, result);
  if (c.power) write_power_csv(folder / "power.csv", c.sweep, *c.radar.link, result);
  stop_if_interrupted();
  write_images(folder, task.prepared.planned->plan, c);
  Manifest& manifest = task.prepared.manifest;
  manifest.peak_rss_bytes = peak_rss_bytes();
  manifest.time.total_s = task.total.seconds();
  write_manifest(folder / "run.json", manifest);
  if (!c.plots) return;
  if (const std::string trouble = draw_rcs(folder, c.title, c.sweep, result, task.prepared.outermost); !trouble.empty())
    warn(trouble);
  stop_if_interrupted();
  std::vector<std::string> tables = image_tables(c);
  if (task.asked.parts) tables.emplace_back("parts.csv");
  if (!tables.empty()) draw_with_python(folder, tables, folder);
}

// Writes and places all results. Returns the text of the product.
std::string place_results(const RunTask& task, const SweepResult& result, const OutputFolder& folder,
                          const std::function<void()>& placed) {
  const auto& [asked, prepared, destination, merged, product, total] = task;
  const Case& c = prepared.c;
  folder.require_there();
  NewResults results(folder.path());
  write_rcs_csv(results.folder() / "rcs.csv", c.sweep, result);
  stop_if_interrupted();
  prepared.manifest.rcs_csv_sha256 = sha256_of_file(results.folder() / "rcs.csv");
  const auto stored_result = [&] {
    StoredResult all = stored(c.sweep, result);
    all.attributes = attributes_of(task.prepared.manifest);
    return all;
  };
  if (c.netcdf && !(product && destination.one_file())) {
    write_netcdf(results.folder() / (destination.one_file() ? destination.file : "rcs.nc"), stored_result());
    stop_if_interrupted();
  }
  if (!destination.one_file()) write_others(task, result, results.folder());
  std::string text;
  if (product) {
    product->source.result = stored_result();
    text = product->make();
    product->write(results.folder(), destination, c.netcdf);
  }
  replace_results(results, folder.path(), names_of_results(asked, c, destination, product ? product->names : ResultNames{}),
                  names_of_earlier_results(destination), placed);
  return text;
}

std::string summary_of(const RunTask& task, const SweepResult& result, const fs::path& folder) {
  const Case& c = task.prepared.c;
  const Manifest& manifest = task.prepared.manifest;
  const dvec3 size = size_of(task.prepared.target->mesh.vertices);
  return summary_text(
      result, {size_text(size, std::ranges::max(c.sweep.frequencies)), c.tubes, !c.sweep.materials.empty(), manifest.threads,
               manifest.looks_resumed, manifest.warnings.size(), Destination{folder, task.destination.file}.text()});
}

}  // namespace

void run_into_folder(const RunTask& task) {
  const auto& [asked, prepared, destination, merged, product, total] = task;
  const OutputFolder folder(destination.folder);
  LookJournal journal(
      LookJournal::file_in(folder.path()), [&] { return identity_of(task.prepared.c, task.prepared.manifest); },
      [&] { folder.require_there(); });
  if (!asked.resume)
    LookJournal::refuse_leftover(journal.file());  // once more: meanwhile another run may have been here
  else if (!journal.resume())
    warn(fmt::format("nothing to resume in {}: the run starts from the beginning", folder.path().string()));
  std::atomic<bool> complete = false;
  const InterruptFlag interrupt_flag([&]() -> std::optional<std::string> {
    if (complete) return {};
    std::string sentence = journal.interrupted_sentence();
    folder.abandon();
    return sentence;
  });
  for (const std::string& sentence : prepared.planned->warnings) warn(sentence);
  bool unusable = false;
  try {
    const SweepResult result = solve(task, journal);
    if (asked.work.ranks) asked.work.ranks->end();
    journal.keep_all();
    unusable = warn_of_unusable_rows(result.statistics);
    warn_of_lost_rays(prepared.c, result.statistics);
    const std::string product_text = place_results(task, result, folder, [&] { complete = true; });
    journal.remove();
    if (!asked.work.quiet) fmt::print("{}{}", summary_of(task, result, folder.path()), product_text);
  } catch (const Interrupted&) {
    throw Interrupted(journal.interrupted_sentence());
  } catch (const std::exception&) {
    if (const std::string kept = journal.keep_all(); !kept.empty()) warn(kept);
    folder.require_there();
    throw;
  }
  if (unusable) throw unusable_rows_in(folder.path());
}

}  // namespace raytube
