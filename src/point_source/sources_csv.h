// What `raytube sources` finds, as a table and as a cloud of points.
#pragma once

#include <filesystem>

#include "point_source/source_study.h"

namespace raytube {

/// One row a launch and part, with the meaning of the columns in its head.
void write_sources_csv(const std::filesystem::path& file, const SourceStudy& study);

/// The launch points of all views, which rays go through or start from, as points with their model, ASCII.
void write_launch_ply(const std::filesystem::path& file, const SourceStudy& study);

/// The hits of all views as points with their model (its index in launch_model_names) and bounce, ASCII.
void write_hits_ply(const std::filesystem::path& file, const SourceStudy& study);

}  // namespace raytube
