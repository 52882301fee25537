#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "output/netcdf/conventions.h"
#include "output/netcdf/hdf5_in_use.h"
#include "output/netcdf/netcdf_file.h"
#include "output/netcdf/open_netcdf.h"

namespace raytube {

namespace {

std::vector<ScatteringMatrix> matrices(const std::vector<double>& real, const std::vector<double>& imaginary, std::size_t first,
                                       std::size_t rows) {
  std::vector<ScatteringMatrix> s(rows);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t c = 0; c < 4; ++c) {
      const std::size_t at = 4 * (first + row) + c;
      s[row].s[c / 2][c % 2] = {real[at], imaginary[at]};
    }
  return s;
}

std::vector<ChannelErrors> levels(const std::vector<double>& values, std::size_t first, std::size_t rows) {
  std::vector<ChannelErrors> levels(rows);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t c = 0; c < 4; ++c) levels[row][c / 2][c % 2] = values[4 * (first + row) + c];
  return levels;
}

class ResultReader {
 public:
  explicit ResultReader(const OpenNetcdf& file) : file_(file) {}

  StoredResult read() {
    check_dimensions();
    read_attributes();
    read_axes();
    read_channels();
    if (file_.has("S_mechanism_re")) read_mechanisms();
    if (file_.has("model_part_m")) read_model_parts();
    if (file_.has("sigma_incoherent_m2")) read_incoherent();
    return std::move(result_);
  }

 private:
  void check_dimensions() const {
    if (!file_.has("S_re")) file_.refuse("holds no variable S_re");
    if (file_.dimension("look") == 0 || file_.dimension("frequency") == 0) file_.refuse("holds no looks or no frequencies");
    if (file_.dimension("receive") != 2 || file_.dimension("transmit") != 2)
      file_.refuse("its dimensions receive and transmit are not v and h");
    const double rows = static_cast<double>(file_.dimension("look")) * static_cast<double>(file_.dimension("frequency"));
    const auto sets = static_cast<double>(1 + file_.dimension("mechanism") + file_.dimension("model_part"));
    file_.check_size(4.0 * sizeof(double) * rows * sets);
  }

  void read_attributes() {
    for (auto& [name, text] : file_.texts()) {
      if (name == comment_attribute)
        result_.comment = std::move(text);
      else if (name == geometry_attribute)
        result_.bistatic = text == "bistatic";
      else if (std::ranges::none_of(convention_attributes,
                                    [&name = name](const FixedAttribute& fixed) { return name == fixed.name; }))
        result_.attributes.emplace_back(name, std::move(text));
    }
    for (auto& named_text : file_.long_texts()) result_.attributes.push_back(std::move(named_text));
  }

  void per_look(const char* name, double StoredLook::*member) {
    const std::vector<double> values = axis(name, "look");
    for (std::size_t i = 0; i < values.size(); ++i) result_.looks[i].*member = values[i];
  }

  // As in tables: what rows are told apart by is finite.
  std::vector<double> axis(const char* name, const char* dimension) const {
    std::vector<double> values = file_.numbers(name, {dimension});
    if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
      file_.refuse(fmt::format("{} holds something that is no finite number", name));
    return values;
  }

  void read_axes() {
    result_.frequency_hz = axis("frequency", "frequency");
    if (std::ranges::min(result_.frequency_hz) <= 0.0) file_.refuse("holds a frequency that is not greater than 0");
    result_.looks.resize(file_.dimension("look"));
    per_look("theta_deg", &StoredLook::theta_deg);
    per_look("phi_deg", &StoredLook::phi_deg);
    per_look("rx_theta_deg", &StoredLook::rx_theta_deg);
    per_look("rx_phi_deg", &StoredLook::rx_phi_deg);
    result_.moving = file_.has("time_s");
    if (result_.moving) per_look("time_s", &StoredLook::time_s);
    if (!file_.has("range_m")) return;
    per_look("range_m", &StoredLook::range_m);
    per_look("rx_range_m", &StoredLook::rx_range_m);
  }

  std::vector<double> of_rows(const char* name) const {
    return file_.numbers(name, {"look", "frequency", "receive", "transmit"});
  }

  std::vector<ChannelErrors> errors(const char* name) const { return levels(of_rows(name), 0, result_.rows()); }

  void read_channels() {
    result_.s = matrices(of_rows("S_re"), of_rows("S_im"), 0, result_.rows());
    result_.sigma_dbsm = errors("sigma_dbsm");
    result_.err_db = errors("err_db");
    result_.model_db = errors("model_db");
    if (file_.has("error_m")) result_.error_m = errors("error_m");
    if (file_.has("model_m")) result_.model_m = errors("model_m");
  }

  void read_mechanisms() {
    const std::size_t rows = result_.rows();
    const auto real = file_.numbers("S_mechanism_re", {"mechanism", "look", "frequency", "receive", "transmit"});
    const auto imaginary = file_.numbers("S_mechanism_im", {"mechanism", "look", "frequency", "receive", "transmit"});
    for (const std::string& name : file_.labels("mechanism"))
      result_.parts.push_back({name, matrices(real, imaginary, result_.parts.size() * rows, rows)});
  }

  void read_model_parts() {
    const std::size_t rows = result_.rows();
    const auto values = file_.numbers("model_part_m", {"model_part", "look", "frequency", "receive", "transmit"});
    for (const std::string& name : file_.labels("model_part"))
      result_.model_parts.push_back({name, levels(values, result_.model_parts.size() * rows, rows)});
  }

  void read_incoherent() {
    const auto values = file_.numbers("sigma_incoherent_m2", {"look", "frequency", "transmit"});
    for (std::size_t row = 0; row < result_.rows(); ++row)
      result_.incoherent_m2.push_back({values[2 * row], values[2 * row + 1]});
  }

  const OpenNetcdf& file_;
  StoredResult result_;
};

}  // namespace

StoredResult read_netcdf(const std::filesystem::path& file) {
  const Hdf5InUse in_use;
  const OpenNetcdf open(file);
  return ResultReader(open).read();
}

std::size_t netcdf_dimension(const std::filesystem::path& file, const char* name) {
  const Hdf5InUse in_use;
  return OpenNetcdf(file).dimension(name);
}

}  // namespace raytube
