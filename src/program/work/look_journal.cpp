#include "program/work/look_journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "core/error.h"
#include "core/text.h"
#include "program/work/results.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto short_run = 1s;                              // has no journal,
constexpr std::size_t most_waiting = std::size_t{4} << 20;  // [bytes] unless more than this would wait
constexpr auto between_writes = 1ms;                        // looks may be finished within microseconds
constexpr auto between_syncs = 1s;
constexpr int sync_share = 100;  // syncing takes less than 1 / this of one thread's time
constexpr std::size_t most_named = 3, longest_value = 40;

// Of a long list, the part from the first different entry on.
std::string shown(const std::string& value, std::size_t differs_at) {
  if (value.empty()) return "not given";
  if (value.size() <= longest_value) return value;
  const std::size_t comma = value.rfind(',', std::min(differs_at, value.size()) - 1);
  const std::size_t from = differs_at == 0 || comma == std::string::npos ? 0 : comma + 1;
  const std::string part = value.substr(from, longest_value);
  return fmt::format("{}{}{}", from > 0 ? "..." : "", part, from + part.size() < value.size() ? "..." : "");
}

// The value of a file or of the program is a checksum, which says nothing to the user; only their names contain blanks.
std::string difference_text(const JournalDifference& item) {
  const auto& [name, before, now] = item;
  if (name.find(' ') != std::string::npos) return "another " + name;
  const auto at = static_cast<std::size_t>(std::ranges::mismatch(before, now).in1 - before.begin());
  return fmt::format("{} = {} (now {})", name, shown(before, at), shown(now, at));
}

}  // namespace

std::string looks_text(std::size_t count) { return fmt::format("{} look{}", count, count == 1 ? "" : "s"); }

std::string differences_text(const JournalIdentity& before, const JournalIdentity& now) {
  const std::vector<JournalDifference> items = differences(before, now);
  std::vector<std::string> sentences;
  for (const JournalDifference& item : items)
    if (sentences.size() < most_named) sentences.push_back(difference_text(item));
  const std::string more = items.size() > most_named ? fmt::format(" and {} more", items.size() - most_named) : "";
  return fmt::format("{}{}", joined(sentences, ", "), more);
}

LookJournal::LookJournal(const fs::path& file, std::function<JournalIdentity()> identity, std::function<void()> require_folder,
                         bool is_result)
    : file_(file), is_result_(is_result), identity_(std::move(identity)), require_folder_(std::move(require_folder)) {}

void LookJournal::refuse_leftover(const fs::path& file) {
  const std::unique_ptr<Journal> left = Journal::reopen(file);
  if (!left || left->records() == 0) return;
  throw InputError(
      fmt::format("{} holds {} that an interrupted run has finished; continue with --resume, or delete the file to start again",
                  file.string(), looks_text(left->records())));
}

bool LookJournal::resume() {
  journal_ = Journal::reopen(file_);
  if (!journal_) return false;
  if (const std::string found = differences_text(journal_->identity(), identity_()); !found.empty())
    throw InputError(
        fmt::format("{} was begun with {}; use the same case, or delete the file (and the finished {} in it) to start "
                    "again",
                    file_.string(), found, looks_text(journal_->records())));
  resumed_ = journal_->records();
  return true;
}

KeptLooks LookJournal::looks() {
  return {[this](std::size_t count) { begin(count); },
          [this](std::size_t index) { return resumed_ > 0 ? journal_->find(index) : std::string(); },
          [this](std::size_t index, std::string bytes) { keep(index, std::move(bytes)); }};
}

void LookJournal::begin(std::size_t looks) {
  const std::lock_guard lock(mutex_);
  looks_ = looks;
  start_ = Clock::now();
}

void LookJournal::keep(std::size_t index, std::string bytes) {
  std::unique_lock lock(mutex_);
  if (given_up_ && is_result_)
    throw std::runtime_error(fmt::format("{}: the disk is full; make room and run the same command again", file_.string()));
  if (given_up_) return;
  waiting_bytes_ += bytes.size();
  waiting_.push_back({index, std::move(bytes)});
  write_if_due(lock);
}

void LookJournal::write_now_and_then() {
  std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock && !given_up_) write_if_due(lock);
}

void LookJournal::write_if_due(std::unique_lock<std::mutex>& lock) {
  const Clock::time_point now = Clock::now();
  const bool is_short = !journal_ && now - start_ < short_run && waiting_bytes_ < most_waiting;
  if (is_short || now - written_ < between_writes) return;
  write();
  if (to_sync_ && !syncing_ && now - synced_ > std::max<Clock::duration>(between_syncs, sync_share * sync_took_)) sync(lock);
}

void LookJournal::write() {
  if (waiting_.empty()) return;
  require_folder_();
  try {
    if (!journal_) journal_ = std::make_unique<Journal>(file_, identity_());
    journal_->add(waiting_);
    to_sync_ = true;
  } catch (const std::exception& error) {
    give_up(error);
  }
  waiting_.clear();
  waiting_bytes_ = 0;
  written_ = Clock::now();
}

// Other threads need not wait for the disk.
void LookJournal::sync(std::unique_lock<std::mutex>& lock) {
  syncing_ = true;
  to_sync_ = false;
  lock.unlock();
  const Clock::time_point start = Clock::now();
  std::string trouble;
  try {
    journal_->sync();
  } catch (const std::system_error& error) {
    trouble = error.what();
  }
  lock.lock();
  syncing_ = false;
  synced_ = Clock::now();
  sync_took_ = synced_ - start;
  if (!trouble.empty() && !given_up_) give_up(std::runtime_error(trouble));
}

void LookJournal::give_up(const std::exception& error) {
  given_up_ = true;
  if (is_result_) throw std::runtime_error(error.what());
  warn(fmt::format("if interrupted, the run can no longer be resumed: {}", error.what()));
}

std::string LookJournal::keep_all() {
  const std::lock_guard lock(mutex_);
  try {
    if (journal_ && !given_up_) write();
  } catch (const std::exception&) {
    // The folder was removed, or the disk is full: the file keeps what it holds.
  }
  if (!journal_ || !journal_->is_there() || journal_->records() == 0) return {};
  return fmt::format("{} of {} looks are kept in {}; {}", journal_->records(), std::max(looks_, journal_->records()),
                     file_.string(), is_result_ ? "the same command continues from there" : "continue with --resume");
}

std::string LookJournal::interrupted_sentence() {
  const std::string kept = keep_all();
  return kept.empty() ? Interrupted().what() : "interrupted; " + kept;
}

void LookJournal::complete() {
  const std::lock_guard lock(mutex_);
  require_folder_();
  if (!journal_) journal_ = std::make_unique<Journal>(file_, identity_());
  journal_->add(waiting_);
  journal_->sync();
  if (journal_->records() != looks_)
    throw std::runtime_error(fmt::format("{}: holds {} of {}, the disk is full; make room and run the same command again",
                                         file_.string(), journal_->records(), looks_text(looks_)));
  waiting_.clear();
}

void LookJournal::remove() {
  const std::lock_guard lock(mutex_);
  given_up_ = true;
  std::error_code ignored;
  if (journal_ && journal_->is_there()) fs::remove(file_, ignored);
}

}  // namespace raytube
