// Where the rows of a table lie, as cuts and maps want it.
#pragma once

#include <span>

#include "output/tables/cuts.h"
#include "output/tables/result_table.h"

namespace raytube {

/// Coordinates of rows with these keys, of which the table has some; the receiver is told where it is elsewhere in any row.
RowCoordinates coordinates_of_keys(std::span<const ResultTable::Keys> rows, const std::array<bool, ResultTable::keys>& has_key);

}  // namespace raytube
