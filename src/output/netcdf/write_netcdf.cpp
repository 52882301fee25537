#include <fmt/format.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <span>
#include <stdexcept>

#include "core/text.h"
#include "output/files/files.h"
#include "output/netcdf/conventions.h"
#include "output/netcdf/hdf5_in_use.h"
#include "output/netcdf/netcdf_file.h"

namespace raytube {

namespace {

// A file on its way, in memory: HDF5 does not survive a disk that does not take what it writes.
class NewNetcdf {
 public:
  explicit NewNetcdf(const std::filesystem::path& path) : path_(path) {
    require(nc_create_mem(path.filename().c_str(), NC_NETCDF4, 0, &file_));
    open_ = true;
    require(nc_set_fill(file_, NC_NOFILL, nullptr));
  }
  ~NewNetcdf() {
    if (open_) nc_abort(file_);
    std::free(contents_.memory);
  }
  NewNetcdf(const NewNetcdf&) = delete;
  NewNetcdf& operator=(const NewNetcdf&) = delete;

  /// The bytes of the file, which belong to this object.
  std::string_view close() {
    require(nc_close_memio(file_, &contents_));
    open_ = false;
    return {static_cast<const char*>(contents_.memory), contents_.size};
  }

  void dimension(const char* name, std::size_t size) {
    int id = 0;
    require(nc_def_dim(file_, name, size, &id));
  }

  int variable(const char* name, nc_type type, std::initializer_list<std::string> dimensions) {
    std::vector<int> ids;
    for (const std::string& dimension : dimensions) require(nc_inq_dimid(file_, dimension.c_str(), &ids.emplace_back()));
    int variable = 0;
    require(nc_def_var(file_, name, type, static_cast<int>(ids.size()), ids.data(), &variable));
    return variable;
  }

  void attribute(int variable, const char* name, const std::string& text) {
    if (!text.empty()) require(nc_put_att_text(file_, variable, name, text.size(), text.data()));
  }

  void put(int variable, const std::vector<double>& values) { require(nc_put_var_double(file_, variable, values.data())); }
  void put(int variable, const std::string& letters) { require(nc_put_var_text(file_, variable, letters.data())); }

  /// One member of a variable's first dimension.
  void put_member(int variable, std::size_t index, std::span<const std::size_t> shape, const std::vector<double>& values) {
    std::vector<std::size_t> start(shape.size() + 1), count = {1};
    start.front() = index;
    count.insert(count.end(), shape.begin(), shape.end());
    require(nc_put_vara_double(file_, variable, start.data(), count.data(), values.data()));
  }

 private:
  void require(int status) const {
    if (status != NC_NOERR)
      throw std::runtime_error(fmt::format("{}: cannot be written ({})", path_.string(), nc_strerror(status)));
  }

  std::filesystem::path path_;
  int file_ = 0;
  bool open_ = false;
  NC_memio contents_{};
};

enum class Component { real, imaginary };

std::vector<double> components(const std::vector<ScatteringMatrix>& rows, Component which) {
  std::vector<double> values;
  values.reserve(4 * rows.size());
  for (const ScatteringMatrix& row : rows)
    for (const auto& receive : row.s)
      for (const Complex s : receive) values.push_back(which == Component::real ? s.real() : s.imag());
  return values;
}

std::vector<double> flat(const std::vector<ChannelErrors>& rows) {
  std::vector<double> values;
  values.reserve(4 * rows.size());
  for (const ChannelErrors& row : rows)
    for (const auto& receive : row) values.insert(values.end(), receive.begin(), receive.end());
  return values;
}

std::vector<double> flat(const std::vector<std::array<double, 2>>& rows) {
  std::vector<double> values;
  for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
  return values;
}

// The file of one result, variable by variable.
class ResultWriter {
 public:
  ResultWriter(NewNetcdf& file, const StoredResult& result)
      : file_(file), result_(result), row_shape_{result.looks.size(), result.frequency_hz.size(), 2, 2} {}

  void write() {
    write_attributes();
    file_.dimension("look", result_.looks.size());
    file_.dimension("frequency", result_.frequency_hz.size());
    write_axes();
    write_channels();
    if (!result_.parts.empty()) write_parts();
    if (!result_.model_parts.empty()) write_model_parts();
    if (!result_.incoherent_m2.empty())
      file_.put(described("sigma_incoherent_m2", {"look", "frequency", "transmit"}, "m2",
                          "incoherent radar cross-section of rough surfaces, both receive polarisations together; adds as power"),
                flat(result_.incoherent_m2));
  }

 private:
  void write_attributes() {
    for (const auto& [name, text] : result_.attributes)
      if (text.size() <= longest_attribute)
        file_.attribute(NC_GLOBAL, name.c_str(), text);
      else
        write_text(name, text);
    file_.attribute(NC_GLOBAL, comment_attribute, result_.comment);
    file_.attribute(NC_GLOBAL, geometry_attribute, result_.bistatic ? "bistatic" : "monostatic");
    for (const auto& [name, text] : convention_attributes) file_.attribute(NC_GLOBAL, name, text);
  }

  void write_text(const std::string& name, const std::string& text) {
    file_.dimension((name + letters_suffix).c_str(), text.size());
    const int variable = file_.variable(name.c_str(), NC_CHAR, {name + letters_suffix});
    file_.attribute(variable, "long_name", "text about the whole, too long for an attribute");
    file_.attribute(variable, "_Encoding", "utf-8");
    file_.put(variable, text);
  }

  int described(const char* name, std::initializer_list<std::string> dimensions, const char* units, const char* long_name) {
    const int variable = file_.variable(name, NC_DOUBLE, dimensions);
    file_.attribute(variable, "units", units);
    file_.attribute(variable, "long_name", long_name);
    return variable;
  }

  // A quantity of every row and channel.
  int channel_variable(const char* name, const char* units, const char* long_name) {
    return of_rows(described(name, {"look", "frequency", "receive", "transmit"}, units, long_name));
  }

  int of_rows(int variable) {
    file_.attribute(
        variable, "coordinates",
        std::string("theta_deg phi_deg rx_theta_deg rx_phi_deg") + (result_.far() ? "" : " range_m rx_range_m"));
    return variable;
  }

  // The names along a dimension. Letters rather than strings: every reader knows them.
  void labels(const std::string& dimension, const std::vector<std::string>& names, const char* long_name) {
    std::size_t length = 0;
    for (const std::string& name : names) length = std::max(length, name.size());
    file_.dimension(dimension.c_str(), names.size());
    file_.dimension((dimension + letters_suffix).c_str(), length);
    const int variable = file_.variable(dimension.c_str(), NC_CHAR, {dimension, dimension + letters_suffix});
    file_.attribute(variable, "long_name", long_name);
    file_.attribute(variable, "_Encoding", "utf-8");
    std::string letters;
    for (std::string name : names) name.resize(length), letters += name;
    file_.put(variable, letters);
  }

  void per_look(const char* name, const char* units, const char* long_name, double StoredLook::*member) {
    std::vector<double> values;
    for (const StoredLook& look : result_.looks) values.push_back(look.*member);
    file_.put(described(name, {"look"}, units, long_name), values);
  }

  void write_axes() {
    labels("receive", {"v", "h"}, "polarisation received");
    labels("transmit", {"v", "h"}, "polarisation transmitted");
    file_.put(described("frequency", {"frequency"}, "Hz", "frequency"), result_.frequency_hz);
    per_look("theta_deg", "degree", "polar angle from +z of the direction to the transmitter", &StoredLook::theta_deg);
    per_look("phi_deg", "degree", "azimuth from +x towards +y of the direction to the transmitter", &StoredLook::phi_deg);
    per_look("rx_theta_deg", "degree", "polar angle from +z of the direction to the receiver", &StoredLook::rx_theta_deg);
    per_look("rx_phi_deg", "degree", "azimuth from +x towards +y of the direction to the receiver", &StoredLook::rx_phi_deg);
    if (result_.far()) return;
    per_look("range_m", "m", "distance of the transmitter from the origin of the mesh", &StoredLook::range_m);
    per_look("rx_range_m", "m", "distance of the receiver from the origin of the mesh", &StoredLook::rx_range_m);
  }

  void write_channels() {
    file_.put(channel_variable("S_re", "m", "real part of the scattering amplitude S"), components(result_.s, Component::real));
    file_.put(channel_variable("S_im", "m", "imaginary part of the scattering amplitude S"),
              components(result_.s, Component::imaginary));
    errors("sigma_dbsm", "dBsm", "radar cross-section, 10 log10(4 pi |S|^2 / 1 m^2)", result_.sigma_dbsm);
    errors("err_db", "dB",
           "estimated numerical error, 20 log10(1 + error_m / max(|S|, S_max / 100)), S_max the row's largest |S|",
           result_.err_db);
    errors("model_db", "dB", "model uncertainty: what asymptotic physics leaves out, from model_m as err_db from error_m",
           result_.model_db);
    errors("error_m", "m", "estimated numerical error of |S|", result_.error_m);
    errors("model_m", "m", "model uncertainty of |S|", result_.model_m);
  }

  void errors(const char* name, const char* units, const char* long_name, const std::vector<ChannelErrors>& rows) {
    if (!rows.empty()) file_.put(channel_variable(name, units, long_name), flat(rows));
  }

  void write_parts() {
    std::vector<std::string> names;
    for (const StoredPart& part : result_.parts) names.push_back(part.name);
    labels("part", names, "mechanism; S is the sum over all of them");
    for (const Component which : {Component::real, Component::imaginary}) {
      const bool real = which == Component::real;
      const int variable =
          of_rows(described(real ? "S_part_re" : "S_part_im", {"part", "look", "frequency", "receive", "transmit"}, "m",
                            real ? "real part of S by mechanism" : "imaginary part of S by mechanism"));
      for (std::size_t i = 0; i < names.size(); ++i)
        file_.put_member(variable, i, row_shape_, components(result_.parts[i].s, which));
    }
  }

  void write_model_parts() {
    std::vector<std::string> names;
    for (const StoredModelPart& part : result_.model_parts) names.push_back(part.name);
    labels("model_part", names, "part of the model uncertainty");
    const int variable = of_rows(described("model_part_m", {"model_part", "look", "frequency", "receive", "transmit"}, "m",
                                           "model uncertainty of |S| by part; model_m is the root of the sum of the squares"));
    for (std::size_t i = 0; i < names.size(); ++i) file_.put_member(variable, i, row_shape_, flat(result_.model_parts[i].m));
  }

  NewNetcdf& file_;
  const StoredResult& result_;
  std::array<std::size_t, 4> row_shape_;
};

}  // namespace

bool is_netcdf_name(const std::filesystem::path& file) { return lower_case(file.extension().string()) == ".nc"; }

void write_netcdf(const std::filesystem::path& file, const StoredResult& result) {
  const Hdf5InUse in_use;
  NewNetcdf open(file);
  ResultWriter(open, result).write();
  OutputFile out(file);
  out.write(open.close());
  out.commit();
}

}  // namespace raytube
