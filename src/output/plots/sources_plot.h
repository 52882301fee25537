// What `raytube sources` finds, as pictures.
#pragma once

#include <filesystem>
#include <string>

#include "scene/source_study.h"

namespace raytube {

/// Draws launch, hits and sources (PNG and SVG) in `folder`, which holds none of them: launch points, hits on the counted part,
/// and errors against rays and time or, for several positions of the source, shares against position. Returns an empty text, or
/// why there is no picture.
std::string plot_sources(const std::filesystem::path& folder, const SourceStudy& study);

}  // namespace raytube
