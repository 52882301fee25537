// What a run's results are called.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "case/data/case.h"
#include "program/commands.h"
#include "program/work/destination.h"
#include "program/work/results.h"

namespace raytube {

/// The case with what one netCDF file alone means for it. Throws InputError for what such a file has no place for.
Case case_for(const Destination& destination, const Request& request, Case c);

/// `product`: what else is written into the folder.
ResultNames names_of_results(const Request& request, const Case& c, const Destination& destination,
                             const ResultNames& product = {});

/// What a run with other wishes may have left, and a page that tells of the results that are replaced. One file replaces nothing
/// but itself.
std::vector<std::string> names_of_earlier_results(const Destination& destination);

}  // namespace raytube
