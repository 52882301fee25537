// Warnings about the mesh before a case is solved, and about the computed rows.
#pragma once

#include <filesystem>

#include "case/data/case.h"
#include "output/files/manifest.h"
#include "plan/target.h"
#include "program/work/exit_codes.h"

namespace raytube {

/// Warns about the mesh files as they were read.
void warn_of_reading(const Case& c, const MeshReport& report);

/// Warns about materials that are not traced as they are drawn, and notes them in the manifest.
void warn_of_materials(const Case& c, const MeshReport& report, const Target& target, Manifest& manifest);

void warn_of_lost_rays(const Case& c, const Statistics& statistics);

/// Warns about rows that must not be used, beyond their bound or without a number, once for each mechanism that has such rows.
/// Returns whether there are any.
bool warn_of_unusable_rows(const Statistics& statistics);

/// To be thrown once the results are written: their other rows are sound.
UnusableRows unusable_rows_in(const std::filesystem::path& folder);

}  // namespace raytube
