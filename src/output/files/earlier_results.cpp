#include "output/files/earlier_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "core/error.h"
#include "output/files/files.h"
#include "output/files/sha256.h"
#include "output/files/sync.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr const char* list_name = ".raytube.results";
constexpr std::size_t digits = 64;  // of a SHA-256 in hexadecimal; two blanks follow, then the name

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(fs::symlink_status(path, ignored));
}

bool is_nothing(const fs::path& path) {
  std::error_code ignored;
  return !fs::exists(fs::symlink_status(path, ignored));
}

// Empty if it cannot be read.
std::string sum_of(const fs::path& path) {
  try {
    return is_file(path) ? sha256_of_file(path) : std::string();
  } catch (const std::runtime_error&) {
    return {};
  }
}

}  // namespace

EarlierResults::EarlierResults(const fs::path& folder) : folder_(folder) {
  std::ifstream list;
  if (is_file(folder / list_name)) list.open(folder / list_name);
  for (std::string line; std::getline(list, line);)
    if (line.size() > digits + 2) entries_.emplace_back(line.substr(digits + 2), line.substr(0, digits));
}

bool EarlierResults::hold(const std::string& name) const {
  if (std::ranges::find(entries_, name, &Entry::first) == entries_.end()) return false;
  return std::ranges::find(entries_, Entry{name, sum_of(folder_ / name)}) != entries_.end();
}

void EarlierResults::require_room(const std::vector<std::string>& names) const {
  if (const fs::path list = folder_ / list_name; !is_nothing(list) && !is_file(list))
    throw InputError(
        fmt::format("{}: the list of results belongs here, and this is not a file; move it away, or choose another folder "
                    "with -o DIR",
                    list.string()));
  for (const std::string& name : names) {
    const fs::path file = folder_ / name;
    if (is_nothing(file) || hold(name)) continue;
    std::error_code ignored;
    const char* what = fs::is_directory(file, ignored) ? "is a folder in the place of a result"
                                                       : "is in the place of a result, and is not as raytube wrote it";
    throw InputError(fmt::format("{}: {}; move it away, or choose another folder with -o DIR", file.string(), what));
  }
}

void EarlierResults::expect(const fs::path& from, const std::vector<std::string>& names) {
  for (const std::string& name : names) expected_.emplace_back(name, sha256_of_file(from / name));
}

void EarlierResults::announce(const fs::path& by_way_of) {
  drop_what_is_gone();
  std::vector<Entry> both = entries_;
  std::erase_if(both, [this](const Entry& entry) { return std::ranges::find(expected_, entry) != expected_.end(); });
  both.insert(both.end(), expected_.begin(), expected_.end());
  write(by_way_of, both);
}

void EarlierResults::settle(const fs::path& by_way_of) {
  std::erase_if(entries_, [this](const Entry& entry) {
    return std::ranges::find(expected_, entry.first, &Entry::first) != expected_.end();
  });
  entries_.insert(entries_.end(), expected_.begin(), expected_.end());
  withdraw(by_way_of);
}

void EarlierResults::withdraw(const fs::path& by_way_of) {
  expected_.clear();
  drop_what_is_gone();
  try {
    write(by_way_of, entries_);
  } catch (const std::runtime_error&) {
    // The list that was announced knows all of these, and some that are gone: no harm.
  }
}

void EarlierResults::drop_what_is_gone() {
  std::erase_if(entries_, [this](const Entry& entry) { return is_nothing(folder_ / entry.first); });
}

void EarlierResults::write(const fs::path& by_way_of, const std::vector<Entry>& entries) const {
  OutputFile list(by_way_of / list_name);
  for (const auto& [name, sum] : entries) list.write(fmt::format("{}  {}\n", sum, name));
  list.commit();
  sync_file(by_way_of / list_name);
  fs::rename(by_way_of / list_name, folder_ / list_name);
}

}  // namespace raytube
