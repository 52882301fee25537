// The keys a case file may hold.
#pragma once

#include "case/document.h"

namespace raytube {

/// Throws InputError at the first key that is unknown (naming the nearest known one) or that later versions will know.
void check_case_keys(const CaseValue& root);

}  // namespace raytube
