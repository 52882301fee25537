// What `raytube sources` leaves: a table, pictures and a cloud of points.
#pragma once

#include <filesystem>
#include <string>

#include "scene/source_study.h"

namespace raytube {

/// One row a launch and part, with the meaning of the columns in its head.
void write_sources_csv(const std::filesystem::path& file, const SourceStudy& study);

/// The hits of all views as points with their model (its place in launch_model_names) and bounce, ASCII.
void write_hits_ply(const std::filesystem::path& file, const SourceStudy& study);

/// Draws launch, hits and sources (PNG and SVG) in `folder`, which holds none of them: launch points, hits on the counted part,
/// and errors against rays and time or, for several positions of the source, shares against position. Returns an empty text, or
/// why there is no picture.
std::string plot_sources(const std::filesystem::path& folder, const SourceStudy& study);

}  // namespace raytube
