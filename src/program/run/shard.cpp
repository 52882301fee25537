#include "program/run/shard.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>

#include "core/error.h"
#include "output/files/folder_lock.h"
#include "program/helping.h"
#include "program/work/destination.h"
#include "program/work/interrupt.h"
#include "program/work/look_journal.h"
#include "program/work/progress_bar.h"
#include "program/work/results.h"
#include "ranks/ranks.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_shards = 1'000'000;

std::size_t slurm_number(const char* variable) {
  const char* const text = std::getenv(variable);
  const std::optional<std::size_t> number = text ? parsed_whole_number(text) : std::nullopt;
  if (!number)
    throw InputError(
        fmt::format("--shard slurm: {} is not set; only the tasks of a job array (sbatch --array=1-N) have it; "
                    "otherwise write --shard I/N",
                    variable));
  return *number;
}

// Slurm does not count the missing tasks of an array, so that the array must have no gaps.
Shard shard_of_array() {
  const std::size_t task = slurm_number("SLURM_ARRAY_TASK_ID"), first = slurm_number("SLURM_ARRAY_TASK_MIN"),
                    last = slurm_number("SLURM_ARRAY_TASK_MAX"), count = slurm_number("SLURM_ARRAY_TASK_COUNT");
  if (last - first + 1 != count)
    throw InputError(
        fmt::format("--shard slurm: the job array has {} tasks from {} to {}, with gaps; to run some shards again "
                    "write --shard $SLURM_ARRAY_TASK_ID/N, with the N of the whole array",
                    count, first, last));
  return {task - first, count};
}

// Several shards may write into the folder at a time, so that none of them holds it as its own.
void make_folder_of_shards(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw InputError(fmt::format("output folder {}: cannot be created ({}); choose another one with -o DIR", folder.string(),
                                 error.message()));
}

// A single task that is run again (sbatch --array=5) would count itself as the whole array.
void refuse_others(const fs::path& folder, const Shard& shard) {
  const std::string own = fmt::format("_of_{}{}", shard.count, shard_ending);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == shard_ending && !entry.path().filename().string().ends_with(own))
      throw InputError(
          fmt::format("--shard {}: {} belongs to another number of shards; write --shard I/N with that N, or choose "
                      "another folder with -o DIR",
                      shard_text(shard), entry.path().string()));
}

// The progress bar counts the looks of this shard alone.
void compute(const RunOptions& asked, const PreparedRun& prepared, const Shard& shard, LookJournal& journal) {
  const std::size_t looks = shard.size(prepared.planned->items());
  ProgressBar bar(asked.work.quiet, fmt::format("shard {}: {}", shard_text(shard), looks_text(looks)),
                  looks > 0 ? static_cast<double>(journal.resumed()) / static_cast<double>(looks) : 1.0);
  const auto progress = [&](double share) {
    journal.write_now_and_then();
    return bar.show(share);
  };
  try {
    solve_shard_of_case(*prepared.planned, shard, progress, journal.looks(), team_of(asked.work));
    if (asked.work.ranks) asked.work.ranks->end();
    journal.complete();
  } catch (const Interrupted&) {
    throw Interrupted(journal.interrupted_sentence());
  } catch (const std::exception&) {
    if (const std::string kept = journal.keep_all(); !kept.empty()) warn(kept);
    throw;
  }
}

JournalIdentity identity_of_shard(const RunOptions& asked, const PreparedRun& prepared, const Shard& shard) {
  JournalIdentity identity = identity_of(prepared.c, prepared.manifest);
  identity.emplace_back(shard_item, shard_text(shard));
  identity.emplace_back(case_item, prepared.manifest.case_file);
  identity.emplace_back(set_item, fmt::format("{}", fmt::join(asked.input.overrides, "\n")));
  return identity;
}

}  // namespace

Shard shard_of_text(const std::string& text) {
  if (text == "slurm") return shard_of_array();
  const std::size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const auto number = parsed_whole_number(std::string_view(text).substr(0, slash)),
               count = parsed_whole_number(std::string_view(text).substr(slash + 1));
    if (number && count && *number >= 1 && *number <= *count && *count <= most_shards) return {*number - 1, *count};
  }
  throw InputError(fmt::format("--shard {}: write I/N, I from 1 to N, such as 3/7, or slurm in a job array", text));
}

std::string shard_text(const Shard& shard) { return fmt::format("{}/{}", shard.index + 1, shard.count); }

void run_shard(const RunOptions& asked, const Case& c, const Stopwatch& total) {
  const Shard shard = shard_of_text(*asked.shard);
  const Destination destination = destination_of(asked.output, c.file.parent_path() / "out", "rcs.csv");
  if (destination.one_file())
    throw InputError(fmt::format("-o {}: a shard is only part of a result; give a folder here, and -o FILE.nc to raytube merge",
                                 asked.output.string()));
  const PreparedRun prepared = prepared_run(asked, c, c, total);
  const std::string name = fmt::format("shard_{}_of_{}{}", shard.index + 1, shard.count, shard_ending);
  const fs::path folder = fs::absolute(destination.folder), file = folder / name;
  make_folder_of_shards(folder);
  refuse_others(folder, shard);
  const FolderLock lock(folder, fmt::format(".{}.lock", name));
  const auto require_folder = [&] {
    if (!lock.holds()) throw_removed(folder);
  };
  LookJournal journal(
      file, [&] { return identity_of_shard(asked, prepared, shard); }, require_folder, true);
  journal.resume();
  const InterruptFlag interrupt_flag([&] { return std::optional(journal.interrupted_sentence()); });
  compute(asked, prepared, shard, journal);
  if (!asked.work.quiet)
    fmt::print("shard {}    {} in {}; when all shards are done: raytube merge {}\n", shard_text(shard),
               looks_text(shard.size(prepared.planned->items())), file.string(), folder.string());
}

}  // namespace raytube
