// One shard of a run: a part of its looks, kept in a file of its own until all shards are merged.
#pragma once

#include <string>

#include "program/run/prepared_run.h"
#include "program/run/stopwatch.h"
#include "solve/solve.h"

namespace raytube {

/// Of "3/7", or of "slurm": what the variables of a Slurm job array say. Throws InputError.
Shard shard_of_text(const std::string& text);

/// "3/7"
std::string shard_text(const Shard& shard);

/// What the files of shards end with.
inline constexpr const char* shard_ending = ".looks";

/// shard_3_of_7.looks
std::string shard_file_name(const Shard& shard);

/// What the items of a shard's journal are called that the looks do not depend on.
inline constexpr const char *shard_item = "shard of the looks", *case_item = "case file", *set_item = "--set options";

/// Computes the shard that is asked for, or what is left of it, into its file in the folder of the results.
void run_shard(const Request& request, const Case& c, const Stopwatch& total);

}  // namespace raytube
