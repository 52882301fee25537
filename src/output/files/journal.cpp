#include "output/files/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "output/files/folder_lock.h"
#include "output/files/sync.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "raytube journal\n";
constexpr std::uint64_t identity_key = std::numeric_limits<std::uint64_t>::max();

constexpr std::size_t small_record = 1 << 16;  // [bytes] copied to be written with its neighbours

using Head = std::array<std::uint64_t, 3>;  // key, length, checksum

[[noreturn]] void fail(const fs::path& path, int error) {
  throw std::system_error(error, std::generic_category(), path.string());
}

// Fowler, Noll & Vo's hash (FNV-1a, 64 bits), eight bytes at a time and folded, since its products carry upwards only. Against
// torn records, not against forgers.
std::uint64_t checksum(std::uint64_t key, std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&hash](std::uint64_t word) {
    hash = (hash ^ word) * 0x100000001b3u;
    hash ^= hash >> 29;
  };
  add(key), add(bytes.size());
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min(sizeof word, bytes.size() - at));
    add(word);
  }
  return hash;
}

// False at the end of the file.
bool read_at(int file, const fs::path& path, std::uint64_t offset, char* to, std::size_t count) {
  while (count > 0) {
    const ssize_t got = pread(file, to, count, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(path, errno);
    if (got == 0) return false;
    to += got, offset += static_cast<std::uint64_t>(got), count -= static_cast<std::size_t>(got);
  }
  return true;
}

void write_at(int file, const fs::path& path, std::uint64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t put = pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) fail(path, put < 0 ? errno : ENOSPC);
    bytes.remove_prefix(static_cast<std::size_t>(put)), offset += static_cast<std::uint64_t>(put);
  }
}

std::string identity_bytes(const JournalIdentity& identity) {
  std::string bytes;
  for (const auto& [name, value] : identity) bytes += name + '\0' + value + '\0';
  return bytes;
}

JournalIdentity identity_of(std::string_view bytes) {
  JournalIdentity identity;
  const auto next = [&bytes] {
    const std::string text(bytes.substr(0, bytes.find('\0')));
    bytes.remove_prefix(std::min(text.size() + 1, bytes.size()));
    return text;
  };
  while (!bytes.empty()) {
    std::string name = next();
    identity.emplace_back(std::move(name), next());
  }
  return identity;
}

}  // namespace

Journal::Journal(int file, const fs::path& path) : path_(path), file_(file) {}

Journal::Journal(const fs::path& path, const JournalIdentity& identity)
    : path_(path), file_(open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666)), identity_(identity) {
  if (file_ < 0) fail(path_, errno);
  try {
    write_at(file_, path_, 0, magic);
    end_ = magic.size();
    add({{identity_key, identity_bytes(identity)}});
    sync();
  } catch (...) {
    close(file_);
    unlink(path_.c_str());
    throw;
  }
  sync_folder(path_.parent_path());
}

std::unique_ptr<Journal> Journal::reopen(const fs::path& path) {
  const int file = open(path.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
  if (file < 0 && errno == ENOENT) return nullptr;
  if (file < 0 && errno == ELOOP)
    throw InputError(fmt::format("{}: is a link, and is not followed; delete it to start afresh", path.string()));
  if (file < 0 && errno == EACCES)
    throw InputError(fmt::format("{}: may not be read and written by you; ask its owner for the right to", path.string()));
  if (file < 0)
    throw InputError(fmt::format("{}: cannot be read ({}); delete it to start afresh", path.string(), std::strerror(errno)));
  std::unique_ptr<Journal> journal(new Journal(file, path));
  try {
    return journal->read_all() ? std::move(journal) : nullptr;
  } catch (const std::system_error& error) {
    throw InputError(fmt::format("{}; delete it to start afresh", error.what()));
  }
}

Journal::~Journal() { close(file_); }

// False if it was stopped while it was begun.
bool Journal::read_all() {
  std::string start(magic.size(), '\0');
  if (!read_at(file_, path_, 0, start.data(), start.size())) return false;
  if (start != magic)
    throw InputError(fmt::format("{}: is no journal of this program; delete it to start afresh", path_.string()));
  end_ = magic.size();
  while (read_record(end_)) continue;
  const auto head = extents_.find(identity_key);
  if (head == extents_.end()) return false;
  identity_ = identity_of(find(identity_key));
  return true;
}

// Moves `at` behind the record that begins there; false if it is not whole.
bool Journal::read_record(std::uint64_t& at) {
  Head head;
  if (!read_at(file_, path_, at, reinterpret_cast<char*>(head.data()), sizeof head)) return false;
  const auto [key, length, sum] = head;
  const off_t size = lseek(file_, 0, SEEK_END);
  if (size < 0 || length > static_cast<std::uint64_t>(size) - at - sizeof head) return false;
  std::string bytes(length, '\0');
  if (!read_at(file_, path_, at + sizeof head, bytes.data(), bytes.size()) || checksum(key, bytes) != sum) return false;
  extents_[key] = {at + sizeof head, length};
  at += sizeof head + length;
  return true;
}

std::size_t Journal::records() const {
  const std::lock_guard lock(mutex_);
  return extents_.size() - 1;
}

std::string Journal::find(std::uint64_t key) const {
  Extent extent;
  {
    const std::lock_guard lock(mutex_);
    const auto found = extents_.find(key);
    if (found == extents_.end()) return {};
    extent = found->second;
  }
  std::string bytes(extent.length, '\0');
  if (!read_at(file_, path_, extent.offset, bytes.data(), bytes.size())) fail(path_, EIO);
  return bytes;
}

// At the end of the last whole record; what an earlier attempt has left behind it is cut off, no earlier than now: whoever only
// looks into a journal leaves it as it is. Small records go in one piece.
void Journal::add(const std::vector<JournalRecord>& records) {
  const std::lock_guard lock(mutex_);
  if (std::exchange(has_tail_, false) && ftruncate(file_, static_cast<off_t>(end_)) != 0) fail(path_, errno);
  std::string piece;
  std::uint64_t at = end_;
  const auto write = [&](const std::string& bytes) {
    write_at(file_, path_, at, bytes);
    at += bytes.size();
  };
  for (const auto& [key, bytes] : records) {
    const Head head{key, bytes.size(), checksum(key, bytes)};
    piece.append(reinterpret_cast<const char*>(head.data()), sizeof head);
    const bool is_small = bytes.size() < small_record;
    if (is_small) piece += bytes;
    if (is_small && piece.size() < small_record) continue;
    write(std::exchange(piece, {}));
    if (!is_small) write(bytes);
  }
  write(piece);
  for (const auto& [key, bytes] : records) {
    extents_[key] = {end_ + sizeof(Head), bytes.size()};
    end_ += sizeof(Head) + bytes.size();
  }
}

bool Journal::is_there() const { return is_still(file_, path_); }

void Journal::sync() {
  if (fdatasync(file_) != 0) fail(path_, errno);
}

std::vector<JournalDifference> differences(const JournalIdentity& before, const JournalIdentity& now) {
  const auto value_in = [](const JournalIdentity& identity, const std::string& name) {
    const auto found = std::ranges::find(identity, name, &JournalIdentity::value_type::first);
    return found == identity.end() ? std::string() : found->second;
  };
  std::vector<JournalDifference> found;
  for (const auto& [name, value] : before)
    if (std::string other = value_in(now, name); other != value) found.push_back({name, value, std::move(other)});
  for (const auto& [name, value] : now)
    if (!value.empty() && value_in(before, name).empty() &&
        std::ranges::find(found, name, &JournalDifference::name) == found.end())
      found.push_back({name, {}, value});
  return found;
}

}  // namespace raytube
