#include <span>
#include <string>
#include <vector>

#include "core/text.h"
#include "output/netcdf/netcdf_file.h"
#include "output/netcdf/new_netcdf.h"

namespace raytube {

namespace {

std::vector<double> by_transmit(const std::vector<std::array<double, 2>>& rows) {
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
    file_.describe(result_);
    file_.dimension("look", result_.looks.size());
    file_.dimension("frequency", result_.frequency_hz.size());
    write_axes();
    write_channels();
    if (!result_.parts.empty()) write_mechanisms();
    if (!result_.model_parts.empty()) write_model_parts();
    if (!result_.incoherent_m2.empty())
      file_.put(
          file_.variable("sigma_incoherent_m2", {"look", "frequency", "transmit"}, "m2",
                         "incoherent radar cross-section of rough surfaces, both receive polarisations together; adds as power"),
          by_transmit(result_.incoherent_m2));
  }

 private:
  // A quantity of every row and channel.
  int channel_variable(const char* name, const char* units, const char* long_name) {
    return of_rows(file_.variable(name, {"look", "frequency", "receive", "transmit"}, units, long_name));
  }

  int of_rows(int variable) {
    file_.attribute(variable, "coordinates",
                    std::string("theta_deg phi_deg rx_theta_deg rx_phi_deg") + (result_.far() ? "" : " range_m rx_range_m") +
                        (result_.moving ? " time_s" : ""));
    return variable;
  }

  void write_axes() {
    file_.polarisations();
    file_.put(file_.variable("frequency", {"frequency"}, "Hz", "frequency"), result_.frequency_hz);
    file_.looks(result_.looks);
    if (!result_.far()) file_.distances(result_.looks);
    if (result_.moving) file_.times(result_.looks);
  }

  void write_channels() {
    file_.put(channel_variable("S_re", "m", "real part of the scattering amplitude S"), components(result_.s, ComplexPart::real));
    file_.put(channel_variable("S_im", "m", "imaginary part of the scattering amplitude S"),
              components(result_.s, ComplexPart::imaginary));
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

  void write_mechanisms() {
    std::vector<std::string> names;
    for (const StoredPart& part : result_.parts) names.push_back(part.name);
    file_.labels("mechanism", names, "mechanism; S is the sum over all of them");
    for (const ComplexPart which : {ComplexPart::real, ComplexPart::imaginary}) {
      const bool real = which == ComplexPart::real;
      const int variable = of_rows(file_.variable(real ? "S_mechanism_re" : "S_mechanism_im",
                                                  {"mechanism", "look", "frequency", "receive", "transmit"}, "m",
                                                  real ? "real part of S by mechanism" : "imaginary part of S by mechanism"));
      for (std::size_t i = 0; i < names.size(); ++i)
        file_.put_member(variable, i, row_shape_, components(result_.parts[i].s, which));
    }
  }

  void write_model_parts() {
    std::vector<std::string> names;
    for (const StoredModelPart& part : result_.model_parts) names.push_back(part.name);
    file_.labels("model_part", names, "part of the model uncertainty");
    const int variable =
        of_rows(file_.variable("model_part_m", {"model_part", "look", "frequency", "receive", "transmit"}, "m",
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
  NewNetcdf out(file);
  ResultWriter(out, result).write();
  out.write();
}

}  // namespace raytube
