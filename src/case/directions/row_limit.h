// How many rows a table may have.
#pragma once

#include <cstddef>

#include "case/text/document.h"

namespace raytube {

/// A table of more is refused: looks times frequencies.
inline constexpr double most_rows = 1e7;

/// Throws InputError at the location of `value`, which asks for so many looks, if they make more rows.
void check_rows(const CaseValue& value, double looks, std::size_t frequencies);

}  // namespace raytube
