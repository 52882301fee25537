// Where a run's results go.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "case/data/case.h"
#include "program/commands.h"
#include "program/work/results.h"

namespace raytube {

/// A folder, or one netCDF file alone in it.
struct Destination {
  std::filesystem::path folder;
  std::string file;  // empty: all files

  bool one_file() const { return !file.empty(); }
  std::string text() const { return (one_file() ? folder / file : folder).string(); }
};

/// Throws InputError for a name that results cannot have.
Destination destination_of(const Request& request, const Case& c);

/// The case with what one netCDF file alone means for it. Throws InputError for what such a file has no place for.
Case case_for(const Destination& destination, const Request& request, Case c);

ResultNames names_of_results(const Request& request, const Case& c, const Destination& destination);

/// What a run with other wishes may have left. One file replaces nothing but itself.
std::vector<std::string> names_of_earlier_results(const Destination& destination);

}  // namespace raytube
