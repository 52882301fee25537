// The shards of a run, as they were left in a folder.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "output/files/journal.h"
#include "program/run/run_results.h"
#include "solve/solve.h"

namespace raytube {

class ShardFiles {
 public:
  /// Opens all shards of a folder. Throws InputError if there is none, if their numbers N differ, or if one is missing or there
  /// twice.
  explicit ShardFiles(const std::filesystem::path& folder);

  /// The case of the shards, and the values of --set that they were computed with.
  std::filesystem::path case_file() const;
  std::vector<std::string> overrides() const;

  /// Throws InputError if a shard belongs to another case, mesh or program, or does not hold all of its share of `looks`.
  void require(const JournalIdentity& identity, std::size_t looks) const;

  /// The looks refer to this object.
  KeptLooks looks() const;

 private:
  struct File {
    std::filesystem::path path;
    Shard shard;
    std::unique_ptr<const Journal> journal;
  };
  void add(const std::filesystem::path& path);
  void require_all() const;

  std::filesystem::path folder_;
  std::vector<File> files_;
};

}  // namespace raytube
