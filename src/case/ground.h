// The ground section of a case.
#pragma once

#include "case/data/case.h"
#include "case/text/document.h"

namespace raytube {

/// Fills c.ground; materials, looks and edges must be known already. Throws InputError for a ground that cannot be, and for what
/// does not go with one.
void read_ground(const CaseValue& root, Case& c);

}  // namespace raytube
