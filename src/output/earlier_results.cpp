#include "output/earlier_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "error.h"
#include "output/files.h"

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
  unlisted_ = unlisted_results(folder, [this](const std::string& name) { return lists(name); });
}

bool EarlierResults::lists(const std::string& name) const {
  return std::ranges::find(entries_, name, &Entry::first) != entries_.end();
}

bool EarlierResults::hold(const std::string& name) const {
  if (unlisted_.contains(name)) return true;
  if (!lists(name)) return false;
  return std::ranges::find(entries_, Entry{name, sum_of(folder_ / name)}) != entries_.end();
}

void EarlierResults::require_room(const std::vector<std::string>& names) const {
  for (const std::string& name : names) {
    const fs::path place = folder_ / name;
    if (is_nothing(place) || hold(name)) continue;
    std::error_code ignored;
    const char* what = fs::is_directory(place, ignored) ? "is a folder where a result is to go"
                                                        : "is where a result is to go, and is not what raytube has written there";
    throw InputError(fmt::format("{}: {}; move it away, or choose another folder with -o DIR", place.string(), what));
  }
}

void EarlierResults::announce(const fs::path& from, const std::vector<std::string>& names) {
  std::erase_if(entries_, [this](const Entry& entry) { return is_nothing(folder_ / entry.first); });
  for (const std::string& name : unlisted_)
    if (is_file(folder_ / name)) entries_.emplace_back(name, sha256_of_file(folder_ / name));
  unlisted_.clear();
  for (const std::string& name : names) announced_.emplace_back(name, sha256_of_file(from / name));
  std::erase_if(entries_, [this](const Entry& entry) { return std::ranges::find(announced_, entry) != announced_.end(); });
  entries_.insert(entries_.end(), announced_.begin(), announced_.end());
  write(from);
}

void EarlierResults::settle(const fs::path& by_way_of) {
  std::erase_if(entries_, [this](const Entry& entry) {
    const auto replaced_by = std::ranges::find(announced_, entry.first, &Entry::first);
    return is_nothing(folder_ / entry.first) || (replaced_by != announced_.end() && *replaced_by != entry);
  });
  try {
    write(by_way_of);
  } catch (const std::runtime_error&) {
    // The list of before knows all of these, and some that are gone: no harm.
  }
}

void EarlierResults::write(const fs::path& by_way_of) const {
  OutputFile list(by_way_of / list_name);
  for (const auto& [name, sum] : entries_) list.write(fmt::format("{}  {}\n", sum, name));
  list.commit();
  fs::rename(by_way_of / list_name, folder_ / list_name);
}

}  // namespace raytube
