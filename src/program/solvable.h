// Whether a case can be solved once its mesh is read: the same answer for whoever asks.
#pragma once

#include "case/case.h"

namespace raytube {

/// Throws InputError, with the case file, for whatever a run of the case would be refused for, but for want of memory.
void check_solvable(const Target& target, const Case& c);

}  // namespace raytube
