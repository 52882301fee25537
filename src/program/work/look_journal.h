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

/// In which items a journal's identity differs from another one, in words; empty: in none.
std::string differences_text(const JournalIdentity& before, const JournalIdentity& now);

/// "1 look", "2 looks"
std::string looks_text(std::size_t count);

/// A file beside the results, by its usual name .raytube.journal. It is begun when the computation has taken a second, so that
/// short runs know nothing of it; from then on a look is there as soon as it is finished, and on the disk itself a second or so
/// later. A disk that does not take it costs a warning: the run goes on.
class LookJournal {
 public:
  /// `identity` is called when it is needed; `require_folder`, from any thread, throws if the folder was removed.
  ///
  /// `is_result`: the file is all that there will be, so that what the disk does not take ends the work.
  LookJournal(const std::filesystem::path& file, std::function<JournalIdentity()> identity,
              std::function<void()> require_folder, bool is_result = false);

  static std::filesystem::path file_in(const std::filesystem::path& folder) { return folder / ".raytube.journal"; }
  const std::filesystem::path& file() const { return file_; }

  /// Throws InputError if finished looks lie in the file: whoever forgot to resume shall not lose them.
  static void refuse_leftover(const std::filesystem::path& file);

  /// Takes up what an earlier run has left; false if there is nothing. Throws InputError if that was another one.
  bool resume();

  /// The finished looks as solve() takes them: those that are kept, and where new ones go. Refers to this object.
  KeptLooks looks();

  /// To be called now and then: finished looks do not wait for the next one.
  void write_now_and_then();

  /// Writes what is left to be written as far as the disk takes it; returns a sentence that says what is kept, empty if nothing is.
  std::string keep_all();

  /// Writes all of them, for good. Throws std::runtime_error if the disk does not take them.
  void complete();

  /// Looks taken up from an earlier run.
  std::size_t resumed() const { return resumed_; }

  /// The results are complete.
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
