// The names of a run's results.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "case/data/case.h"
#include "program/options.h"
#include "program/work/destination.h"
#include "program/work/results.h"

namespace raytube {

/// The case as it is run for this destination: for a single netCDF file, without the outputs that the file cannot hold. Throws
/// InputError if the run makes no sense without them.
Case case_for(const Destination& destination, const RunOptions& run, Case c);

/// `product`: names of further files in the folder.
ResultNames names_of_results(const RunOptions& run, const Case& c, const Destination& destination,
                             const ResultNames& product = {});

/// Files that a run with other options may have left, and the report on the replaced results. One file replaces only itself.
std::vector<std::string> names_of_earlier_results(const Destination& destination);

}  // namespace raytube
