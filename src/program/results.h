// How every command brings its results into their folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "output/files.h"

namespace raytube {

/// One line on stderr; the program goes on.
void warn(const std::string& sentence);

/// Throws Interrupted once Ctrl-C was pressed.
void stop_if_interrupted();

/// Last words of a command that keeps nothing of what it has not finished.
std::string without_results(const OutputFolder& folder);

/// Removes all the named files, so that nothing of an earlier command stands beside the new results, then places those that were
/// written, in the order given: whoever finds the last one finds all. A plot is a convenience: one that cannot take its place
/// costs a warning and does not hold up the tables. `placed` is called when all is done, before an interrupt may say otherwise.
void replace_results(const NewResults& results, const std::filesystem::path& folder, const std::vector<std::string>& pictures,
                     const std::vector<std::string>& tables, const std::function<void()>& placed = {});

}  // namespace raytube
