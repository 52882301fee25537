// --only: rows of a table that are asked for.
#pragma once

#include <string>

#include "output/tables/result_table.h"

namespace raytube {

/// Rows whose column lies in low...high.
struct Only {
  ResultTable::Key key;
  double low, high;
};

/// COLUMN=VALUE or COLUMN=LOW:HIGH. Throws InputError for anything else.
Only parsed_only(const std::string& option);

}  // namespace raytube
