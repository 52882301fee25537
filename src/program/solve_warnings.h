// What is to be said of the mesh before a case is solved, and of rows that came out.
#pragma once

#include <filesystem>

#include "case/data/case.h"
#include "output/files/manifest.h"
#include "plan/target.h"
#include "program/work/exit_codes.h"

namespace raytube {

/// Warns of what is to be said of the mesh files as they were read.
void warn_of_reading(const Case& c, const MeshReport& report);

/// Warns of what of the materials is not seen as it is drawn, and notes it in the manifest.
void warn_of_materials(const Case& c, const MeshReport& report, const Target& target, Manifest& manifest);

void warn_of_lost_rays(const Case& c, const Statistics& statistics);

/// Of rows that must not be used, beyond their bound or without a number: a warning for each mechanism that has such rows;
/// whether there are any.
bool warn_of_unusable_rows(const Statistics& statistics);

/// To be thrown once the results are written: other rows of them are sound.
UnusableRows unusable_rows_in(const std::filesystem::path& folder);

}  // namespace raytube
