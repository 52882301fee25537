// Records kept on disk while a program goes, so that one that dies loses little. A record is whole or is not there: each has its
// length and a checksum, and whatever follows the last whole one is cut off.
//
//   file    "raytube journal\n", then records; numbers are 64 bits, in the machine's own order
//   record  key, length, checksum of key, length and bytes, then the bytes
//   the first record, of key 2^64 - 1, says what the others belong to
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace raytube {

/// What the records of a journal belong to, item by item: a name and a value.
using JournalIdentity = std::vector<std::pair<std::string, std::string>>;

struct JournalRecord {
  std::uint64_t key;
  std::string bytes;
};

class Journal {
 public:
  /// Begins one in the place of whatever lies there. Throws std::system_error if it cannot be written.
  Journal(const std::filesystem::path& file, const JournalIdentity& identity);

  /// Takes up the one that lies there; null if there is none, or one that was stopped before it had begun. Throws InputError if
  /// the file is no journal, or cannot be read.
  static std::unique_ptr<Journal> reopen(const std::filesystem::path& file);

  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  const JournalIdentity& identity() const { return identity_; }

  // The following may be called from any thread.

  std::size_t records() const;

  /// The bytes of a key; empty: none. Throws std::system_error if they can no longer be read.
  std::string find(std::uint64_t key) const;

  /// Appends records. From then on they outlive the program, not yet the power. Throws std::system_error if the disk does not
  /// take them; what was there before stays.
  void add(const std::vector<JournalRecord>& records);

  /// False once somebody has removed the file.
  bool is_there() const;

  /// Brings to the disk itself what was added so far. Throws std::system_error.
  void sync();

 private:
  struct Extent {
    std::uint64_t offset, length;  // of the bytes
  };
  Journal(int file, const std::filesystem::path& path);
  bool read_all();
  bool read_record(std::uint64_t& at);

  std::filesystem::path path_;
  int file_;
  JournalIdentity identity_;
  std::unordered_map<std::uint64_t, Extent> extents_;
  std::uint64_t end_ = 0;  // of the last whole record
  bool has_tail_ = true;   // perhaps: something that is no whole record behind it
  mutable std::mutex mutex_;
};

/// An item in which two identities differ; where only one of them has it, the other value is empty.
struct JournalDifference {
  std::string name, before, now;
  friend bool operator==(const JournalDifference&, const JournalDifference&) = default;
};

/// The items in which two identities differ, in the order of the first one.
std::vector<JournalDifference> differences(const JournalIdentity& before, const JournalIdentity& now);

}  // namespace raytube
