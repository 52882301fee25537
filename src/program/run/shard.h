// One shard of a run: a part of its looks, kept in a file of its own until all shards are merged.
#pragma once

#include <string>

#include "program/run/prepared_run.h"
#include "program/run/stopwatch.h"
#include "solve/solve.h"

namespace raytube {

/// Reads "3/7", or for "slurm" the variables of a Slurm job array. Throws InputError.
Shard shard_of_text(const std::string& text);

/// "3/7"
std::string shard_text(const Shard& shard);

/// The ending of shards' files.
inline constexpr const char* shard_ending = ".looks";

/// The items of a shard's journal on which its looks do not depend.
inline constexpr const char *shard_item = "shard of the looks", *case_item = "case file", *set_item = "--set options";

/// Computes the shard, or the rest of it, into its file in the folder of the results.
void run_shard(const RunOptions& asked, const Case& c, const Stopwatch& total);

}  // namespace raytube
