// Runs gnuplot on a script.
#pragma once

#include <filesystem>
#include <string>

namespace raytube {

/// Empty if gnuplot ran the script, otherwise what went wrong.
std::string run_gnuplot(const std::filesystem::path& script);

}  // namespace raytube
