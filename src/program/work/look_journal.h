// The finished looks of a run, kept beside its results until these are complete.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "output/files/journal.h"
#include "solve/solve.h"

namespace raytube {

/// The items in which two identities differ, in words; empty for equal ones.
std::string differences_text(const JournalIdentity& before, const JournalIdentity& now);

/// "1 look", "2 looks"
std::string looks_text(std::size_t count);

/// A file beside the results, usually .raytube.journal. It is begun once the computation has taken a second, so that short runs
/// do without it; from then on each look is written when it is finished, and is safe on the disk about a second later. A full
/// disk costs a warning, and the run goes on.
class LookJournal {
 public:
  /// `identity` is called when it is needed; `require_folder`, from any thread, throws if the folder was removed. `is_result`:
  /// the file is the only result, so that a full disk ends the work.
  LookJournal(const std::filesystem::path& file, std::function<JournalIdentity()> identity, std::function<void()> require_folder,
              bool is_result = false);

  static std::filesystem::path file_in(const std::filesystem::path& folder) { return folder / ".raytube.journal"; }
  const std::filesystem::path& file() const { return file_; }

  /// Throws InputError if the file holds finished looks, so that a run without --resume does not lose them.
  static void refuse_leftover(const std::filesystem::path& file);

  /// Takes up the looks of an earlier run; false if there are none. Throws InputError if that run had other work.
  bool resume();

  /// The kept looks and the place for new ones, in the form that solve() takes. Refers to this object.
  KeptLooks looks();

  /// Writes finished looks that are due; to be called now and then.
  void write_now_and_then();

  /// Writes the remaining looks as far as the disk takes them. Returns a sentence about the kept looks, empty if there are none.
  std::string keep_all();

  /// Keeps all, and returns the sentence with which interrupted work ends.
  std::string interrupted_sentence();

  /// Writes all looks to the disk itself. Throws std::runtime_error if the disk does not take them.
  void complete();

  /// The number of looks taken up from an earlier run.
  std::size_t resumed() const { return resumed_; }

  /// Removes the file: the results are complete.
  void remove();

 private:
  using Clock = std::chrono::steady_clock;
  void begin(std::size_t looks);
  void keep(std::size_t index, std::string bytes);
  void write_if_due(std::unique_lock<std::mutex>& lock);
  void write();
  void sync(std::unique_lock<std::mutex>& lock);
  void give_up(const std::exception& error);

  std::filesystem::path file_;
  bool is_result_;
  std::function<JournalIdentity()> identity_;
  std::function<void()> require_folder_;
  std::unique_ptr<Journal> journal_;
  std::size_t looks_ = 0, resumed_ = 0;
  std::vector<JournalRecord> waiting_;
  std::size_t waiting_bytes_ = 0;
  bool given_up_ = false, syncing_ = false, to_sync_ = false;
  Clock::time_point start_ = Clock::now(), written_{}, synced_{};
  Clock::duration sync_took_{};
  std::mutex mutex_;
};

}  // namespace raytube
