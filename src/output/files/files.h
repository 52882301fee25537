// The room of results: what is written, read back and compared. It knows results, neither meshes nor rays nor cases.
//
//     files    how files come to be: folders, locks, hashes, run.json, the journal of finished looks
//     netcdf   results as netCDF-4 files, written and read
//     tables   rcs.csv and its relatives, written; tables from any source, read
//     vtk      results in space, for ParaView
//     products range profiles, images and scattering centres, written
//     compare  two results beside each other, convergence over tube density
//     words    summaries, counts and warnings as sentences
//     picture  the plain picture of a run, by gnuplot; all others are the Python package's
//
// Each includes only from those before it. Angles in tables are in degrees, frequencies in Hz, S in metres, sigma in dBsm;
// channels pq = vv, vh, hv, hh name the receive polarisation first.
//
// This file: all results of a run are written in a hidden folder beside their place and take it together, so that nothing
// half-written carries a result's name and earlier results stay until the new ones are complete.
#pragma once

#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "output/files/folder_lock.h"

namespace raytube {

/// Throws std::runtime_error: the folder of the results was removed during the work.
[[noreturn]] void throw_removed(const std::filesystem::path& folder);

/// The folder results go to, for one program at a time. Created if missing; a folder created here and still empty in the end is
/// removed again.
class OutputFolder {
 public:
  /// Throws InputError if the folder cannot be created or written to, or if another program is at work for it. Removes what
  /// killed ones have left half-written.
  explicit OutputFolder(const std::filesystem::path& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  // The following may be called from any thread.

  /// Throws std::runtime_error if the folder was removed or moved away.
  void require_there() const;

  /// Clears up as the destructor would, except for the lock: for a program that is about to end without unwinding. A later call
  /// of require_there() waits for that end.
  void abandon() const;

 private:
  void remove_if_empty() const;

  std::filesystem::path path_;
  std::filesystem::path first_created_;  // empty if everything existed
  std::optional<FolderLock> lock_;
  mutable std::mutex mutex_;  // held for good by abandon()
};

/// The files of one run on their way into `destination`: written in folder(), then placed. Whatever was not placed is removed.
class NewResults {
 public:
  /// Throws std::runtime_error if the hidden folder cannot be created.
  explicit NewResults(const std::filesystem::path& destination);
  ~NewResults();
  NewResults(const NewResults&) = delete;
  NewResults& operator=(const NewResults&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

  /// Brings what was written to the disk itself. Throws std::runtime_error if the disk did not take everything.
  void sync() const;

  /// Renames those of the named files that were written, in the order given, over what lies there: each place has the earlier
  /// file or the new one at any time. Throws std::runtime_error if one cannot take its place.
  void place(const std::vector<std::string>& names);

  /// True for a file that place() has put there.
  bool has_placed(const std::string& name) const;

  /// Puts back what lay in their places before.
  void take_back();

 private:
  using Placed = std::pair<std::string, std::filesystem::path>;  // and where the earlier file is kept
  std::filesystem::path kept_earlier(const std::string& name, std::error_code& error) const;

  std::filesystem::path destination_, folder_;
  std::vector<Placed> placed_;
};

/// A text file. Complete only after commit().
class OutputFile {
 public:
  /// Throws std::runtime_error if nothing can be written there.
  explicit OutputFile(const std::filesystem::path& path);

  void write(std::string_view text) { stream_.write(text.data(), static_cast<std::streamsize>(text.size())); }

  /// Throws std::runtime_error if the disk did not take everything.
  void commit();

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
};

}  // namespace raytube
