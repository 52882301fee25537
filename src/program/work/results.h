// How commands bring their results into a folder.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "output/files/files.h"
#include "program/work/interrupt.h"

namespace raytube {

/// Prints one line on stderr; the program goes on.
void warn(const std::string& sentence);

/// Throws Interrupted once Ctrl-C was pressed.
void stop_if_interrupted();

/// The names of a command's results, in the order in which they take their places: once the last table is there, all are.
struct ResultNames {
  std::vector<std::string> pictures, tables;
};

/// A file that a command reads, and what names it to the user: a key of the case, or an option.
using InputFile = std::pair<std::string, std::filesystem::path>;

/// Throws InputError if results of these names cannot go to the folder, or would replace an input, or a file that no earlier
/// command has written. To be called before the computation.
void check_output(const std::filesystem::path& folder, const ResultNames& names, const std::vector<InputFile>& inputs);

/// Places the written results over those of earlier commands, then removes earlier results under the other names and under those
/// in `leftovers`. Throws, and leaves everything as it was: InputError if something else now lies in a result's place,
/// std::runtime_error if a place cannot be taken or the disk did not take the files. A plot that cannot take its place only costs
/// a warning. `placed` is called when all is safe on the disk, and before an interrupt is reported.
void replace_results(NewResults& results, const std::filesystem::path& folder, const ResultNames& names,
                     const std::vector<std::string>& leftovers, const std::function<void()>& placed);

/// The folder of a result that an option names. The result takes its place by a rename. Throws InputError if that would replace a
/// folder, a device or a file that is not raytube's own: those begin with the line `head`.
std::filesystem::path folder_of_named_file(const char* option, const std::filesystem::path& file, std::string_view head);

/// The results of a command that keeps nothing of what it has not finished: an interrupt leaves the folder as it was.
class AllOrNothing {
 public:
  explicit AllOrNothing(const std::filesystem::path& folder);

  const std::filesystem::path& folder() const { return folder_.path(); }

  /// Calls `write` with a hidden folder for the files, and places them as replace_results() does. Returns the names of those that
  /// took their places.
  std::vector<std::string> place(const ResultNames& names, const std::function<void(const std::filesystem::path&)>& write,
                                 const std::vector<std::string>& leftovers = {});

 private:
  OutputFolder folder_;
  std::atomic<bool> complete_ = false;
  InterruptFlag interrupt_flag_;
};

}  // namespace raytube
