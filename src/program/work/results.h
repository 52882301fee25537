// How every command brings its results into their folder.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "output/files/files.h"

namespace raytube {

/// One line on stderr; the program goes on.
void warn(const std::string& sentence);

/// Throws Interrupted once Ctrl-C was pressed.
void stop_if_interrupted();

/// The names of a command's results, in the order in which they take their places: whoever finds the last table finds all.
struct ResultNames {
  std::vector<std::string> pictures, tables;
};

/// A file that a command reads, and what names it to the user: a key of the case, or an option.
using InputFile = std::pair<std::string, std::filesystem::path>;

/// Throws InputError if results of these names cannot go to the folder, or if they would replace an input, or a file that no
/// earlier command has written: better now than after the computation.
void check_output(const std::filesystem::path& folder, const ResultNames& names, const std::vector<InputFile>& inputs);

/// Places the results that were written, over those of earlier commands; then removes what these have left under any other of the
/// names, and of the names in `leftovers`. Throws with all as it was: InputError if something else lies in a result's place by
/// now, std::runtime_error if one cannot be had or the disk did not take the files. A plot is a convenience: one that cannot take
/// its place costs a warning and does not hold up the tables. `placed` is called when all is done and on the disk itself, before
/// an interrupt may say otherwise.
void replace_results(NewResults& results, const std::filesystem::path& folder, const ResultNames& names,
                     const std::vector<std::string>& leftovers, const std::function<void()>& placed);

/// The folder of a result that an option names. Throws InputError if it cannot take its place: by a rename, which must not
/// replace a folder, a device or somebody else's file; one of raytube's own begins with the line `head`.
std::filesystem::path folder_of_named_file(const char* option, const std::filesystem::path& file, std::string_view head);

/// A command that keeps nothing of what it has not finished.
class AllOrNothing {
 public:
  explicit AllOrNothing(const OutputFolder& folder) : folder_(folder) {}

  void complete() { complete_ = true; }

  /// Of an interrupt: none once it is complete.
  std::optional<std::string> last_words() const;

 private:
  const OutputFolder& folder_;
  std::atomic<bool> complete_ = false;
};

}  // namespace raytube
