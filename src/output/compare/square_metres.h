// Tables whose levels are in square metres where decibels are expected.
#pragma once

#include "output/compare/match_rows.h"
#include "output/tables/result_table.h"

namespace raytube {

/// Throws InputError if levels of one table, read as dBsm, agree with the other table only when they are taken as square metres.
void refuse_square_metres(const ResultTable& result, const ResultTable& reference, const RowMatch& match);

}  // namespace raytube
