// Two images and their difference side by side.
#pragma once

#include <filesystem>
#include <string>

#include "output/image_compare/image_comparison.h"

namespace raytube {

/// Draws compare.png in `folder`, which holds none: one row a channel with signal, within 40 dB. Returns an empty text, or why
/// there is no picture.
std::string plot_comparison(const std::filesystem::path& folder, const ImageComparison& comparison);

}  // namespace raytube
