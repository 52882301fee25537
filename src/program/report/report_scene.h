// The target of a result in space, and where the return of chosen looks comes from.
#pragma once

#include "output/report/scene_json.h"
#include "program/report/report_source.h"

namespace raytube {

/// Looks that are asked for, else those whose images the run has left, else the strongest, if it is quick to solve. What cannot
/// be shown is noted in `source`. Throws InputError for looks that are asked for and cannot be had.
ReportScene report_scene(ReportSource& source, const std::vector<std::size_t>& looks);

}  // namespace raytube
