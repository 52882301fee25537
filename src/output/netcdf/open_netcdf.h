// A netCDF file, open to be read.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace raytube {

/// While it lives, nobody else may be in HDF5 (hdf5_in_use.h). Throws InputError for whatever cannot be read.
class OpenNetcdf {
 public:
  explicit OpenNetcdf(const std::filesystem::path& path);
  ~OpenNetcdf();
  OpenNetcdf(const OpenNetcdf&) = delete;
  OpenNetcdf& operator=(const OpenNetcdf&) = delete;

  [[noreturn]] void refuse(const std::string& problem) const;

  bool has(const char* variable) const;
  /// 0 for a dimension that is not there.
  std::size_t dimension(const char* name) const;
  std::vector<double> numbers(const char* name, std::initializer_list<std::string> dimensions) const;
  /// The names along a dimension.
  std::vector<std::string> labels(const std::string& dimension) const;
  /// All global attributes that are text.
  std::vector<std::pair<std::string, std::string>> texts() const;
  /// Texts too long for attributes: variables with letters alone.
  std::vector<std::pair<std::string, std::string>> long_texts() const;
  /// Refuses dimensions that no file of its size can hold: compression gives a thousandth at best.
  void check_size(double bytes) const;

 private:
  void require(const char* what, int status) const;
  int variable(const char* name, std::initializer_list<std::string> dimensions) const;
  std::size_t size_of(int variable) const;

  std::filesystem::path path_;
  int file_ = 0;
};

}  // namespace raytube
