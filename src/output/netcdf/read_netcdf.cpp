#include <fmt/format.h>
#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "output/netcdf/conventions.h"
#include "output/netcdf/hdf5_in_use.h"
#include "output/netcdf/netcdf_file.h"

namespace raytube {

namespace {

using Names = std::vector<std::string>;

class OpenNetcdf {
 public:
  explicit OpenNetcdf(const std::filesystem::path& path) : path_(path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
      throw InputError(fmt::format("{}: cannot be read; give the path of a netCDF file, for example out/rcs.nc{}", path.string(),
                                   backslash_remedy(path.string())));
    if (const int status = nc_open(std::filesystem::absolute(path).c_str(), NC_NOWRITE, &file_); status != NC_NOERR)
      refuse(fmt::format("cannot be read ({})", nc_strerror(status)));
  }
  ~OpenNetcdf() { nc_close(file_); }
  OpenNetcdf(const OpenNetcdf&) = delete;
  OpenNetcdf& operator=(const OpenNetcdf&) = delete;

  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError(
        fmt::format("{}: {}; give a netCDF file that raytube run or raytube convert has written", path_.string(), problem));
  }

  bool has(const char* variable) const {
    int id = 0;
    return nc_inq_varid(file_, variable, &id) == NC_NOERR;
  }

  /// 0 for a dimension that is not there.
  std::size_t dimension(const char* name) const {
    int id = 0;
    std::size_t size = 0;
    return nc_inq_dimid(file_, name, &id) == NC_NOERR && nc_inq_dimlen(file_, id, &size) == NC_NOERR ? size : 0;
  }

  std::vector<double> numbers(const char* name, std::initializer_list<std::string> dimensions) const {
    const int id = variable(name, dimensions);
    std::vector<double> values(size_of(id));
    require(name, nc_get_var_double(file_, id, values.data()));
    return values;
  }

  /// The names along a dimension.
  Names labels(const std::string& dimension) const {
    const int id = variable(dimension.c_str(), {dimension, dimension + letters_suffix});
    check_size(static_cast<double>(size_of(id)));
    std::string letters(size_of(id), '\0');
    require(dimension.c_str(), nc_get_var_text(file_, id, letters.data()));
    Names names(this->dimension(dimension.c_str()));
    const std::size_t length = names.empty() ? 0 : letters.size() / names.size();
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = letters.substr(i * length, length).c_str();  // up to the first \0
    return names;
  }

  /// All global attributes that are text.
  std::vector<std::pair<std::string, std::string>> texts() const {
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

  /// Texts too long for attributes: variables with letters alone.
  std::vector<std::pair<std::string, std::string>> long_texts() const {
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

  /// Refuses dimensions that no file of its size can hold: compression gives a thousandth at best.
  void check_size(double bytes) const {
    std::error_code ignored;
    if (bytes > 1100.0 * static_cast<double>(std::filesystem::file_size(path_, ignored)))
      refuse("its dimensions are larger than the file");
  }

 private:
  void require(const char* what, int status) const {
    if (status != NC_NOERR) refuse(fmt::format("{} cannot be read ({})", quotable(what), nc_strerror(status)));
  }

  int variable(const char* name, std::initializer_list<std::string> dimensions) const {
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

  std::size_t size_of(int variable) const {
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

  std::filesystem::path path_;
  int file_ = 0;
};

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
    if (file_.has("S_part_re")) read_parts();
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
    const auto sets = static_cast<double>(1 + file_.dimension("part") + file_.dimension("model_part"));
    file_.check_size(4.0 * sizeof(double) * rows * sets);
  }

  void read_attributes() {
    for (auto& [name, text] : file_.texts()) {
      if (name == comment_attribute)
        result_.comment = std::move(text);
      else if (name == geometry_attribute)
        result_.bistatic = text == "bistatic";
      else if (std::ranges::none_of(convention_attributes, [&](const FixedAttribute& fixed) { return name == fixed.name; }))
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

  void read_parts() {
    const std::size_t rows = result_.rows();
    const auto real = file_.numbers("S_part_re", {"part", "look", "frequency", "receive", "transmit"});
    const auto imaginary = file_.numbers("S_part_im", {"part", "look", "frequency", "receive", "transmit"});
    for (const std::string& name : file_.labels("part"))
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

}  // namespace raytube
