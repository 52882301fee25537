#include "output/files/files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "output/files/sync.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void not_writable(const fs::path& path, const std::string& reason) {
  throw InputError(fmt::format("output folder {}: {}; choose another one with -o DIR", path.string(), reason));
}

// The topmost folder that create_directories(path) has to make.
fs::path first_missing(const fs::path& path) {
  fs::path missing;
  std::error_code ignored;
  for (fs::path at = path; !at.empty() && !fs::exists(at, ignored); at = at.parent_path()) missing = at;
  return missing;
}

// A hidden name in the same folder, where a rename to `path` is atomic; distinct for each process.
fs::path temporary_beside(const fs::path& path) {
  return path.parent_path() / fmt::format(".{}.{}.part", path.filename().string(), getpid());
}

// The process that has made what lies under the name of temporary_beside.
std::optional<pid_t> process_of(std::string_view name) {
  constexpr std::string_view ending = ".part";
  for (const std::string_view beginning : {".results.", ".probe."}) {
    if (!name.starts_with(beginning) || !name.ends_with(ending) || name.size() <= beginning.size() + ending.size()) continue;
    const std::string_view number = name.substr(beginning.size(), name.size() - beginning.size() - ending.size());
    if (number.size() > 9 || number.find_first_not_of("0123456789") != std::string_view::npos) continue;
    pid_t process = 0;
    std::from_chars(number.data(), number.data() + number.size(), process);
    return process;
  }
  return std::nullopt;
}

// Removes what temporary_beside names in a folder: of this process, and unless `own_only` of those that are no more.
void remove_leftovers(const fs::path& folder, bool own_only) {
  std::error_code ignored;
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::optional<pid_t> process = process_of(entry.path().filename().string());
    if (!process) continue;
    const bool is_gone = !own_only && kill(*process, 0) != 0 && errno == ESRCH;
    if (*process == getpid() || is_gone) found.push_back(entry.path());
  }
  for (const fs::path& path : found) fs::remove_all(path, ignored);
}

}  // namespace

void throw_removed(const fs::path& folder) {
  throw std::runtime_error(
      fmt::format("the output folder {} was removed, and the finished work in it is lost; start again", folder.string()));
}

OutputFolder::OutputFolder(const fs::path& path) {
  std::error_code error;
  path_ = fs::absolute(path, error).lexically_normal();
  if (error) not_writable(path, "cannot be found from here (" + error.message() + ")");
  if (!path_.has_filename()) path_ = path_.parent_path();  // "out/" is "out"
  const fs::path missing = first_missing(path_);
  fs::create_directories(path_, error);
  if (!error && !fs::is_directory(path_)) error = std::make_error_code(std::errc::not_a_directory);
  if (error) not_writable(path, "cannot be created (" + error.message() + ")");
  first_created_ = missing;
  try {
    lock_.emplace(path_);
    remove_leftovers(path_, false);  // also of this process's number: in a container they come again
    const fs::path probe = temporary_beside(path_ / "probe");
    if (!std::ofstream(probe)) not_writable(path, "cannot be written to");
    fs::remove(probe, error);
  } catch (const InputError&) {
    lock_.reset();
    remove_if_empty();
    throw;
  }
}

OutputFolder::~OutputFolder() {
  lock_.reset();
  remove_if_empty();
}

void OutputFolder::require_there() const {
  const std::lock_guard lock(mutex_);
  if (!lock_->holds()) throw_removed(path_);
}

void OutputFolder::abandon() const {
  mutex_.lock();  // for good: a thread that finds the folder gone now must not report that, but wait for the end
  remove_leftovers(path_, true);
  if (lock_) lock_->remove_file();
  remove_if_empty();
}

void OutputFolder::remove_if_empty() const {
  if (first_created_.empty()) return;
  std::error_code error;
  for (fs::path at = path_; fs::remove(at, error) && at != first_created_;) at = at.parent_path();  // stops at a folder in use
}

NewResults::NewResults(const fs::path& destination)
    : destination_(destination), folder_(temporary_beside(destination / "results")) {
  std::error_code error;
  if (fs::create_directory(folder_, error)) return;
  const std::string reason = error ? error.message() : "it is there; remove it";
  throw std::runtime_error(fmt::format("{}: cannot be created ({})", folder_.string(), reason));
}

NewResults::~NewResults() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void NewResults::sync() const {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) sync_file(entry.path());
}

void NewResults::place(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (!fs::exists(folder_ / name)) continue;
    std::error_code error;
    const fs::path earlier = kept_earlier(name, error);
    if (!error) fs::rename(folder_ / name, destination_ / name, error);
    if (error)
      throw std::runtime_error(fmt::format("{}: cannot be replaced ({})", (destination_ / name).string(), error.message()));
    placed_.emplace_back(name, earlier);
  }
}

// Under another name, as far as the file system has links, otherwise as a copy. Empty if there is none.
fs::path NewResults::kept_earlier(const std::string& name, std::error_code& error) const {
  const fs::path there = destination_ / name;
  fs::path kept = folder_ / fmt::format(".earlier.{}", placed_.size());
  if (!fs::exists(fs::symlink_status(there))) return {};
  fs::create_hard_link(there, kept, error);
  if (error) fs::copy_file(there, kept, error);
  return kept;
}

bool NewResults::has_placed(const std::string& name) const {
  return std::ranges::find(placed_, name, &Placed::first) != placed_.end();
}

void NewResults::take_back() {
  std::error_code ignored;
  for (auto placed = placed_.rbegin(); placed != placed_.rend(); ++placed) {
    const auto& [name, earlier] = *placed;
    if (earlier.empty())
      fs::remove(destination_ / name, ignored);
    else
      fs::rename(earlier, destination_ / name, ignored);
  }
  placed_.clear();
}

OutputFile::OutputFile(const fs::path& path) : path_(path), stream_(path, std::ios::binary) {
  if (!stream_) throw std::runtime_error(fmt::format("{}: cannot be written", path.string()));
}

void OutputFile::commit() {
  stream_.close();
  if (!stream_) refuse_unwritten(path_);
}

}  // namespace raytube
