#include "program/run/result_names.h"

#include <fmt/format.h>

#include "core/error.h"
#include "program/images.h"

namespace raytube {

namespace fs = std::filesystem;

Case case_for(const Destination& destination, const RunOptions& run, Case c) {
  if (!destination.one_file()) return c;
  if (!c.image_looks.empty())
    warn(fmt::format("{}: output.image_look has no effect with -o {}; images need a folder", c.file.string(),
                     run.output.string()));
  if (c.power)
    warn(fmt::format("{}: output.power_dbm has no effect with -o {}; power.csv needs a folder", c.file.string(),
                     run.output.string()));
  c.image_looks.clear();
  c.plots = false;
  c.netcdf = true;
  return c;
}

ResultNames names_of_results(const RunOptions& run, const Case& c, const Destination& destination, const ResultNames& product) {
  if (destination.one_file()) return {{}, {destination.file}};
  ResultNames names = image_names(c);
  names.pictures.insert(names.pictures.end(), product.pictures.begin(), product.pictures.end());
  names.tables.insert(names.tables.end(), product.tables.begin(), product.tables.end());
  if (c.plots) names.pictures.insert(names.pictures.end(), {"rcs.png", "rcs.svg"});
  if (c.plots && run.parts) names.pictures.insert(names.pictures.end(), {"parts.png", "parts.svg"});
  names.tables.emplace_back("channels.csv");
  if (run.parts) names.tables.emplace_back("parts.csv");
  if (c.incoherent) names.tables.emplace_back("incoherent.csv");
  if (c.power) names.tables.emplace_back("power.csv");
  if (c.netcdf) names.tables.emplace_back("rcs.nc");
  names.tables.insert(names.tables.end(), {"rcs.csv", "run.json"});
  return names;
}

std::vector<std::string> names_of_earlier_results(const Destination& destination) {
  if (destination.one_file()) return {};
  std::vector<std::string> names = names_of_images(destination.folder);
  names.insert(names.end(), {"incoherent.csv", "parts.csv", "parts.png", "parts.svg", "power.csv", "rcs.nc", "rcs.png", "rcs.svg",
                             "report.html"});
  return names;
}

}  // namespace raytube
