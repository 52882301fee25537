#include "output/netcdf/open_netcdf.h"

#include <fmt/format.h>
#include <netcdf.h>

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "output/netcdf/conventions.h"

namespace raytube {

namespace {

using Names = std::vector<std::string>;

}  // namespace

OpenNetcdf::OpenNetcdf(const std::filesystem::path& path) : path_(path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw InputError(fmt::format("{}: cannot be read; give the path of a netCDF file, for example out/rcs.nc{}", path.string(),
                                 backslash_remedy(path.string())));
  if (const int status = nc_open(std::filesystem::absolute(path).c_str(), NC_NOWRITE, &file_); status != NC_NOERR)
    refuse(fmt::format("cannot be read ({})", nc_strerror(status)));
}

OpenNetcdf::~OpenNetcdf() { nc_close(file_); }

void OpenNetcdf::refuse(const std::string& problem) const {
  throw InputError(
      fmt::format("{}: {}; give a netCDF file that raytube run or raytube convert has written", path_.string(), problem));
}

bool OpenNetcdf::has(const char* variable) const {
  int id = 0;
  return nc_inq_varid(file_, variable, &id) == NC_NOERR;
}

std::size_t OpenNetcdf::dimension(const char* name) const {
  int id = 0;
  std::size_t size = 0;
  return nc_inq_dimid(file_, name, &id) == NC_NOERR && nc_inq_dimlen(file_, id, &size) == NC_NOERR ? size : 0;
}

std::vector<double> OpenNetcdf::numbers(const char* name, std::initializer_list<std::string> dimensions) const {
  const int id = variable(name, dimensions);
  std::vector<double> values(size_of(id));
  require(name, nc_get_var_double(file_, id, values.data()));
  return values;
}

Names OpenNetcdf::labels(const std::string& dimension) const {
  const int id = variable(dimension.c_str(), {dimension, dimension + letters_suffix});
  check_size(static_cast<double>(size_of(id)));
  std::string letters(size_of(id), '\0');
  require(dimension.c_str(), nc_get_var_text(file_, id, letters.data()));
  Names names(this->dimension(dimension.c_str()));
  const std::size_t length = names.empty() ? 0 : letters.size() / names.size();
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = letters.substr(i * length, length).c_str();  // up to the first \0
  return names;
}

std::vector<std::pair<std::string, std::string>> OpenNetcdf::texts() const {
  int count = 0;
  require("attributes", nc_inq_natts(file_, &count));
  std::vector<std::pair<std::string, std::string>> found;
  for (int i = 0; i < count; ++i) {
    char name[NC_MAX_NAME + 1] = {};
    nc_type type = NC_NAT;
    std::size_t length = 0;
    require("attributes", nc_inq_attname(file_, NC_GLOBAL, i, name));
    require(name, nc_inq_att(file_, NC_GLOBAL, name, &type, &length));
    if (type != NC_CHAR) continue;
    std::string text(length, '\0');
    require(name, nc_get_att_text(file_, NC_GLOBAL, name, text.data()));
    found.emplace_back(name, std::move(text));
  }
  return found;
}

std::vector<std::pair<std::string, std::string>> OpenNetcdf::long_texts() const {
  int count = 0;
  require("variables", nc_inq_nvars(file_, &count));
  std::vector<std::pair<std::string, std::string>> found;
  for (int id = 0; id < count; ++id) {
    char name[NC_MAX_NAME + 1] = {};
    nc_type type = NC_NAT;
    int dimensions = 0;
    require("variables", nc_inq_var(file_, id, name, &type, &dimensions, nullptr, nullptr));
    if (type != NC_CHAR || dimensions != 1) continue;
    variable(name, {name + std::string(letters_suffix)});
    check_size(static_cast<double>(size_of(id)));
    std::string text(size_of(id), '\0');
    require(name, nc_get_var_text(file_, id, text.data()));
    found.emplace_back(name, std::move(text));
  }
  return found;
}

void OpenNetcdf::check_size(double bytes) const {
  std::error_code ignored;
  if (bytes > 1100.0 * static_cast<double>(std::filesystem::file_size(path_, ignored)))
    refuse("its dimensions are larger than the file");
}

void OpenNetcdf::require(const char* what, int status) const {
  if (status != NC_NOERR) refuse(fmt::format("{} cannot be read ({})", quotable(what), nc_strerror(status)));
}

int OpenNetcdf::variable(const char* name, std::initializer_list<std::string> dimensions) const {
  int id = 0, count = 0;
  if (nc_inq_varid(file_, name, &id) != NC_NOERR) refuse(fmt::format("holds no variable {}", name));
  require(name, nc_inq_varndims(file_, id, &count));
  std::vector<int> ids(static_cast<std::size_t>(count));
  require(name, nc_inq_vardimid(file_, id, ids.data()));
  Names names;
  for (const int each : ids) {
    char text[NC_MAX_NAME + 1] = {};
    require(name, nc_inq_dimname(file_, each, text));
    names.emplace_back(text);
  }
  if (!std::ranges::equal(names, dimensions))
    refuse(fmt::format("{} has the dimensions ({}) in the place of ({})", name, quotable(joined(names, ", ")),
                       joined(Names(dimensions), ", ")));
  return id;
}

std::size_t OpenNetcdf::size_of(int variable) const {
  int count = 0;
  nc_inq_varndims(file_, variable, &count);
  std::vector<int> ids(static_cast<std::size_t>(count));
  nc_inq_vardimid(file_, variable, ids.data());
  std::size_t product = 1;
  for (const int id : ids) {
    std::size_t size = 0;
    nc_inq_dimlen(file_, id, &size);
    product *= size;
  }
  return product;
}

}  // namespace raytube
