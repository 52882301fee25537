// The directions a case asks for.
#pragma once

#include "case/data/case.h"
#include "case/directions/looks_csv.h"
#include "case/text/document.h"

namespace raytube {

/// Fills c.looks, c.sweep.looks and c.sweep.bistatic from [look] and [receive]; frequencies must be known already.
/// Throws InputError.
void read_looks(const CaseValue& root, Case& c);

/// The same from numbers, which stand in the place of [look] and [receive] of the case. Throws InputError.
void fill_looks(const LookNumbers& numbers, const CaseValue& root, Case& c);

}  // namespace raytube
