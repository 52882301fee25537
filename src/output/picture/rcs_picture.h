// The one plain picture that a run draws of its result. All others are drawn by the Python package.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "scene/results.h"
#include "scene/sweep.h"

namespace raytube {

/// Draws rcs.png and rcs.svg in `folder`, which holds neither: sigma of the four channels over the swept quantity, or maps of VV
/// and HH of a sweep over two. Rows that lie too far apart for the lobes of a target with these outermost points
/// (scene/sampling.h) are not joined by lines. Returns an empty text, or why there is no picture.
std::string draw_rcs(const std::filesystem::path& folder, const std::string& title, const Sweep& sweep, const SweepResult& result,
                     std::span<const dvec3> outermost);

}  // namespace raytube
