// raytube report reads the results of a run.
//
//     report          the command: views, page, file
//     report_source   what lies in the folder;  report_scene: the target in space, and where the return of looks comes from
//     report_centres  scattering centres, if raytube centres has left them there
#pragma once

#include <string>
#include <vector>

#include "core/json.h"
#include "program/products.h"

namespace raytube {

struct ReportSource {
  std::filesystem::path file;        // the result
  ProductSource product;             // with its parts and incoherent returns, where there are any
  JsonValue run;                     // run.json, or what a netCDF file says of its run; null: nothing is known
  std::vector<std::string> notes{};  // what a report lacks, and why
};

/// Of a folder, or of a result in one. Throws InputError for a folder without one, and for files that raytube has not written.
ReportSource report_source(const Request& request);

}  // namespace raytube
