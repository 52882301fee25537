#include "output/netcdf/new_netcdf.h"

#include <fmt/format.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "output/files/files.h"
#include "output/netcdf/conventions.h"
#include "output/netcdf/hdf5_in_use.h"

namespace raytube {

NewNetcdf::NewNetcdf(const std::filesystem::path& path) : in_use_(std::make_unique<Hdf5InUse>()), path_(path) {
  require(nc_create_mem(path.filename().c_str(), NC_NETCDF4, 0, &file_));
  open_ = true;
  require(nc_set_fill(file_, NC_NOFILL, nullptr));
}

NewNetcdf::~NewNetcdf() {
  if (open_) nc_abort(file_);
}

void NewNetcdf::require(int status) const {
  if (status != NC_NOERR)
    throw std::runtime_error(fmt::format("{}: cannot be written ({})", path_.string(), nc_strerror(status)));
}

void NewNetcdf::write() {
  NC_memio contents{};
  require(nc_close_memio(file_, &contents));
  open_ = false;
  const std::unique_ptr<void, decltype(&std::free)> owned(contents.memory, &std::free);
  OutputFile out(path_);
  out.write(std::string_view(static_cast<const char*>(contents.memory), contents.size));
  out.commit();
}

void NewNetcdf::dimension(const std::string& name, std::size_t size) {
  int id = 0;
  require(nc_def_dim(file_, name.c_str(), size, &id));
}

int NewNetcdf::defined(const std::string& name, int type, const std::vector<std::string>& dimensions) {
  std::vector<int> ids;
  for (const std::string& dimension : dimensions) require(nc_inq_dimid(file_, dimension.c_str(), &ids.emplace_back()));
  int variable = 0;
  require(nc_def_var(file_, name.c_str(), type, static_cast<int>(ids.size()), ids.data(), &variable));
  return variable;
}

int NewNetcdf::variable(const std::string& name, const std::vector<std::string>& dimensions, const std::string& units,
                        const std::string& long_name) {
  const int variable = defined(name, NC_DOUBLE, dimensions);
  attribute(variable, "units", units);
  attribute(variable, "long_name", long_name);
  return variable;
}

void NewNetcdf::letters(const std::string& name, const std::vector<std::string>& dimensions, const std::string& long_name,
                        const std::string& text) {
  const int variable = defined(name, NC_CHAR, dimensions);
  attribute(variable, "long_name", long_name);
  attribute(variable, "_Encoding", "utf-8");
  require(nc_put_var_text(file_, variable, text.data()));
}

void NewNetcdf::texts(const std::string& name, const std::string& dimension, const std::vector<std::string>& values,
                      const std::string& long_name) {
  std::size_t length = 1;  // a dimension of none is one without an end
  for (const std::string& value : values) length = std::max(length, value.size());
  this->dimension(name + letters_suffix, length);
  std::string text;
  for (std::string value : values) value.resize(length), text += value;
  letters(name, {dimension, name + letters_suffix}, long_name, text);
}

void NewNetcdf::labels(const std::string& dimension, const std::vector<std::string>& names, const std::string& long_name) {
  this->dimension(dimension, names.size());
  texts(dimension, dimension, names, long_name);
}

void NewNetcdf::polarisations() {
  labels("receive", {"v", "h"}, "polarisation received");
  labels("transmit", {"v", "h"}, "polarisation transmitted");
}

void NewNetcdf::attribute(int variable, const std::string& name, const std::string& text) {
  if (!text.empty()) require(nc_put_att_text(file_, variable, name.c_str(), text.size(), text.data()));
}

void NewNetcdf::attribute(const std::string& name, const std::string& text) {
  if (text.size() <= longest_attribute) return attribute(NC_GLOBAL, name, text);
  dimension(name + letters_suffix, text.size());
  letters(name, {name + letters_suffix}, "text about the whole, too long for an attribute", text);
}

void NewNetcdf::attribute(const std::string& name, std::span<const double> numbers) {
  require(nc_put_att_double(file_, NC_GLOBAL, name.c_str(), NC_DOUBLE, numbers.size(), numbers.data()));
}

void NewNetcdf::describe(const StoredResult& result) {
  for (const auto& [name, text] : result.attributes) attribute(name, text);
  attribute(NC_GLOBAL, comment_attribute, result.comment);
  attribute(NC_GLOBAL, geometry_attribute, result.bistatic ? "bistatic" : "monostatic");
  for (const auto& [name, text] : convention_attributes) attribute(NC_GLOBAL, name, text);
}

void NewNetcdf::per_look(std::span<const StoredLook> looks, const char* name, const char* units, const char* long_name,
                         double StoredLook::*member) {
  std::vector<double> values;
  for (const StoredLook& look : looks) values.push_back(look.*member);
  put(variable(name, {"look"}, units, long_name), values);
}

void NewNetcdf::looks(std::span<const StoredLook> looks) {
  per_look(looks, "theta_deg", "degree", "polar angle from +z of the direction to the transmitter", &StoredLook::theta_deg);
  per_look(looks, "phi_deg", "degree", "azimuth from +x towards +y of the direction to the transmitter", &StoredLook::phi_deg);
  per_look(looks, "rx_theta_deg", "degree", "polar angle from +z of the direction to the receiver", &StoredLook::rx_theta_deg);
  per_look(looks, "rx_phi_deg", "degree", "azimuth from +x towards +y of the direction to the receiver", &StoredLook::rx_phi_deg);
}

void NewNetcdf::distances(std::span<const StoredLook> looks) {
  per_look(looks, "range_m", "m", "distance of the transmitter from the origin of the mesh", &StoredLook::range_m);
  per_look(looks, "rx_range_m", "m", "distance of the receiver from the origin of the mesh", &StoredLook::rx_range_m);
}

void NewNetcdf::times(std::span<const StoredLook> looks) {
  per_look(looks, "time_s", "s", "time of the look", &StoredLook::time_s);
}

void NewNetcdf::put(int variable, const std::vector<double>& values) {
  require(nc_put_var_double(file_, variable, values.data()));
}

void NewNetcdf::put_member(int variable, std::size_t index, std::span<const std::size_t> shape,
                           const std::vector<double>& values) {
  std::vector<std::size_t> start(shape.size() + 1), count = {1};
  start.front() = index;
  count.insert(count.end(), shape.begin(), shape.end());
  require(nc_put_vara_double(file_, variable, start.data(), count.data(), values.data()));
}

std::vector<double> components(const std::vector<ScatteringMatrix>& rows, ComplexPart which) {
  std::vector<double> values;
  values.reserve(4 * rows.size());
  for (const ScatteringMatrix& row : rows)
    for (const auto& receive : row.s)
      for (const Complex s : receive) values.push_back(which == ComplexPart::real ? s.real() : s.imag());
  return values;
}

std::vector<double> flat(const std::vector<ChannelErrors>& rows) {
  std::vector<double> values;
  values.reserve(4 * rows.size());
  for (const ChannelErrors& row : rows)
    for (const auto& receive : row) values.insert(values.end(), receive.begin(), receive.end());
  return values;
}

}  // namespace raytube
