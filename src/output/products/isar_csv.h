// Images of sweeps as a table.
#pragma once

#include <filesystem>

#include "imaging/isar.h"

namespace raytube {

/// isar.csv: one row per cell, the last axis fastest: coordinates along the image's axes, place in the mesh's coordinates,
/// complex amplitude and sigma of the four channels.
void write_isar_csv(const std::filesystem::path& file, const IsarImage& image, const Window& window);

/// What the axes are called in columns: "range", "cross_range", "height".
const char* axis_name(std::size_t axis);

}  // namespace raytube
