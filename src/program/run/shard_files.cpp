#include "program/run/shard_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "core/error.h"
#include "core/text.h"
#include "program/run/shard.h"
#include "program/work/look_journal.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_listed = 10;

std::string value_of(const JournalIdentity& identity, const char* name) {
  const auto found = std::ranges::find(identity, name, &JournalIdentity::value_type::first);
  return found == identity.end() ? "" : found->second;
}

// The identity without the items on which looks do not depend.
JournalIdentity identity_of_looks(JournalIdentity identity) {
  std::erase_if(identity,
                [](const auto& item) { return item.first == shard_item || item.first == case_item || item.first == set_item; });
  return identity;
}

}  // namespace

ShardFiles::ShardFiles(const fs::path& folder) : folder_(folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == shard_ending) found.push_back(entry.path());
  if (error)
    throw InputError(fmt::format("{}: cannot be read ({}); name the folder of the shards", folder.string(), error.message()));
  if (found.empty())
    throw InputError(fmt::format("{}: holds no shards (shard_*{}); make them with raytube run CASE.toml --shard 1/N -o {}",
                                 folder.string(), shard_ending, folder.string()));
  std::ranges::sort(found);
  for (const fs::path& path : found) add(path);
  require_all();
}

void ShardFiles::add(const fs::path& path) {
  std::unique_ptr<const Journal> journal = Journal::reopen(path);
  const std::string text = journal ? value_of(journal->identity(), shard_item) : "";
  if (text.empty())
    throw InputError(fmt::format("{}: is truncated, or not a shard; run its shard again, or delete the file", path.string()));
  const Shard shard = shard_of_text(text);
  for (const File& other : files_) {
    if (other.shard.count != shard.count)
      throw InputError(
          fmt::format("{} is shard {}, but {} is shard {}: they belong to different runs; delete the shards of one run",
                      path.string(), text, other.path.string(), shard_text(other.shard)));
    if (other.shard.index == shard.index)
      throw InputError(fmt::format("{} and {} are both shard {}; delete one of them", other.path.string(), path.string(), text));
  }
  files_.push_back({path, shard, std::move(journal)});
}

void ShardFiles::require_all() const {
  const std::size_t count = files_.front().shard.count;
  std::vector<std::string> missing;
  for (std::size_t index = 0; index < count && missing.size() <= most_listed; ++index)
    if (std::ranges::none_of(files_, [&](const File& file) { return file.shard.index == index; }))
      missing.push_back(missing.size() < most_listed ? fmt::format("{}/{}", index + 1, count) : "more");
  if (missing.empty()) return;
  throw InputError(fmt::format("{}: {} of {} shards {} missing: {}; run each with raytube run {} --shard {} -o {}",
                               folder_.string(), count - files_.size(), count, count - files_.size() == 1 ? "is" : "are",
                               joined(missing, ", "), case_file().string(), missing.front(), folder_.string()));
}

fs::path ShardFiles::case_file() const { return value_of(files_.front().journal->identity(), case_item); }

std::vector<std::string> ShardFiles::overrides() const {
  std::vector<std::string> all;
  std::string lines = value_of(files_.front().journal->identity(), set_item);
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    all.push_back(lines.substr(0, end));
    lines.erase(0, end + 1);
  }
  return all;
}

void ShardFiles::require(const JournalIdentity& identity, std::size_t looks) const {
  for (const auto& [path, shard, journal] : files_) {
    if (const std::string found = differences_text(identity_of_looks(journal->identity()), identity); !found.empty())
      throw InputError(fmt::format("{} was computed with {}; run shard {} again, or merge with the case of the shards",
                                   path.string(), found, shard_text(shard)));
    const std::size_t all = shard.size(looks);
    if (journal->records() != all)
      throw InputError(
          fmt::format("{} holds {} of its {}: it was interrupted, is still running, or is truncated; run shard {} "
                      "again, which continues from there",
                      path.string(), journal->records(), looks_text(all), shard_text(shard)));
  }
}

KeptLooks ShardFiles::looks() const {
  std::vector<const Journal*> journals(files_.size());
  for (const File& file : files_) journals[file.shard.index] = file.journal.get();
  return {{}, [journals](std::size_t look) { return journals[look % journals.size()]->find(look); }, {}};
}

}  // namespace raytube
