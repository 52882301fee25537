#include "program/run/result_names.h"

#include <fmt/format.h>

#include <set>

#include "core/error.h"
#include "output/files/unlisted_results.h"
#include "output/plots/polar_plot.h"
#include "program/images.h"

namespace raytube {

namespace fs = std::filesystem;

Case case_for(const Destination& destination, const Request& request, Case c) {
  if (!destination.one_file()) return c;
  if (request.random)
    throw InputError(
        fmt::format("-o {}: one netCDF file has no place for the spread of random tubes; give a folder, or leave out "
                    "--launch random",
                    request.output_folder.string()));
  if (!c.image_looks.empty())
    warn(fmt::format("{}: output.image_look has no effect with -o {}: give a folder for images", c.file.string(),
                     request.output_folder.string()));
  if (c.power)
    warn(fmt::format("{}: output.power_dbm has no effect with -o {}: give a folder for power.csv", c.file.string(),
                     request.output_folder.string()));
  c.image_looks.clear();
  c.plots = false;
  c.netcdf = true;
  return c;
}

ResultNames names_of_results(const Request& request, const Case& c, const Destination& destination) {
  if (destination.one_file()) return {{}, {destination.file}};
  ResultNames names = image_names(c);
  if (c.plots) names.pictures.insert(names.pictures.end(), {"rcs.png", "rcs.svg"});
  if (c.plots && has_full_circle(c.sweep)) names.pictures.insert(names.pictures.end(), {"rcs_polar.png", "rcs_polar.svg"});
  if (c.plots && request.parts) names.pictures.insert(names.pictures.end(), {"parts.png", "parts.svg"});
  names.tables.emplace_back("channels.csv");
  if (request.parts) names.tables.emplace_back("parts.csv");
  if (c.incoherent) names.tables.emplace_back("incoherent.csv");
  if (c.power) names.tables.emplace_back("power.csv");
  if (request.random) names.tables.emplace_back("random.csv");
  if (c.netcdf) names.tables.emplace_back("rcs.nc");
  names.tables.insert(names.tables.end(), {"rcs.csv", "run.json"});
  return names;
}

std::vector<std::string> names_of_earlier_results(const Destination& destination) {
  if (destination.one_file()) return {};
  const std::set<std::string> images = names_of_images(destination.folder);
  std::vector<std::string> names(images.begin(), images.end());
  names.insert(names.end(), {"incoherent.csv", "parts.csv", "parts.png", "parts.svg", "power.csv", "random.csv", "rcs.nc",
                             "rcs.png", "rcs.svg", "rcs_polar.png", "rcs_polar.svg", "report.html"});
  return names;
}

}  // namespace raytube
