// Commands and pictures of the Python package: the program computes and stores, the package shows.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace raytube {

/// The commands of the package, with their descriptions.
inline constexpr std::pair<const char*, const char*> python_commands[] = {
    {"plot", "Draw results as curves, maps, polar curves, images"},
    {"statistics", "Mean, percentiles and distribution of sigma"},
    {"report", "One page of HTML from the results of a run"}};

/// Runs `python3 -m raytube` with these words, the command's name first. Returns its exit code; where the package cannot be
/// found, one sentence on stderr names it and the code is 3.
int run_python(const std::vector<std::string>& words);

/// Draws the pictures of these files of `folder` beside them, as raytube plot does. `run`: the folder of the run, or the case,
/// whose title and target they show; perhaps empty. Returns whether there are pictures; otherwise a warning says why not, and how
/// to draw them later. Throws Interrupted after Ctrl-C.
bool draw_with_python(const std::filesystem::path& folder, const std::vector<std::string>& files,
                      const std::filesystem::path& run = {});

}  // namespace raytube
