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
  /// Opens all of a folder. Throws InputError if it has none, if they are of different numbers, or one is missing or there twice.
  explicit ShardFiles(const std::filesystem::path& folder);

  /// The case that they are of, and what --set gave with it.
  std::filesystem::path case_file() const;
  std::vector<std::string> overrides() const;

  /// Throws InputError if one is of another case, mesh or program than this, or does not hold all of its part of so many looks.
  void require(const JournalIdentity& identity, std::size_t looks) const;

  /// Refer to this object.
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
