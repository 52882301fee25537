// Rows of a solve that must not be used: beyond their bound, or without a number.
#pragma once

#include <filesystem>
#include <stdexcept>

#include "scene/results.h"

namespace raytube {

/// A warning for each mechanism that has such rows; whether there are any.
bool warn_of_unusable_rows(const Statistics& statistics);

/// What makes the program end with 1. To be thrown once the results are written: other rows of them are sound.
std::runtime_error unusable_rows_in(const std::filesystem::path& folder);

}  // namespace raytube
