// Bodies that move and times at which they are looked at: the [motion] section.
#pragma once

#include "case/data/case.h"
#include "case/text/document.h"

namespace raytube {

/// Fills c.motion, c.sweep.times and, with those of every time after one another, c.sweep.looks; looks and antennas must be known
/// already. Throws InputError.
void read_motion(const CaseValue& root, Case& c);

/// The tables of poses that a case reads, relative to its folder.
std::vector<std::string> pose_tables(const Case& c);

}  // namespace raytube
