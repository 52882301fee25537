// The ground section of a case.
#pragma once

#include "case/data/case.h"
#include "case/text/document.h"

namespace raytube {

/// Fills c.ground; materials, looks and the radar must be known already. Throws InputError for a ground that cannot be, and for
/// looks from below it.
void read_ground(const CaseValue& root, Case& c);

}  // namespace raytube
