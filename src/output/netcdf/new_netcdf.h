// A netCDF-4 file on its way, and what files of results, profiles and images say alike.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "output/netcdf/stored_result.h"

namespace raytube {

class Hdf5InUse;

/// In memory until it is written: HDF5 does not survive a disk that does not take what it writes. Equal calls give equal bytes.
/// While it lives, no other thread of ours is in HDF5, and nobody else may be. Throws std::runtime_error where netCDF fails.
class NewNetcdf {
 public:
  explicit NewNetcdf(const std::filesystem::path& path);
  ~NewNetcdf();
  NewNetcdf(const NewNetcdf&) = delete;
  NewNetcdf& operator=(const NewNetcdf&) = delete;

  void dimension(const std::string& name, std::size_t size);
  /// A variable of doubles.
  int variable(const std::string& name, const std::vector<std::string>& dimensions, const std::string& units,
               const std::string& long_name);
  /// A text for each member of a dimension, and of one that these make. Letters rather than strings: every reader knows them.
  void texts(const std::string& name, const std::string& dimension, const std::vector<std::string>& values,
             const std::string& long_name);
  void labels(const std::string& dimension, const std::vector<std::string>& names, const std::string& long_name);
  /// receive and transmit, of which every channel has one each.
  void polarisations();

  /// None without text.
  void attribute(int variable, const std::string& name, const std::string& text);
  /// Of the whole; a long one as a variable of letters.
  void attribute(const std::string& name, const std::string& text);
  void attribute(const std::string& name, std::span<const double> numbers);
  /// What the result says of itself, and the conventions of all results.
  void describe(const StoredResult& result);
  /// Directions of looks, and how far away these are.
  void looks(std::span<const StoredLook> looks);
  void distances(std::span<const StoredLook> looks);
  /// When looks are taken.
  void times(std::span<const StoredLook> looks);

  void put(int variable, const std::vector<double>& values);
  /// One member of a variable's first dimension.
  void put_member(int variable, std::size_t index, std::span<const std::size_t> shape, const std::vector<double>& values);

  /// Onto the disk; the last call.
  void write();

 private:
  void require(int status) const;
  int defined(const std::string& name, int type, const std::vector<std::string>& dimensions);
  void letters(const std::string& name, const std::vector<std::string>& dimensions, const std::string& long_name,
               const std::string& text);
  void per_look(std::span<const StoredLook> looks, const char* name, const char* units, const char* long_name,
                double StoredLook::*member);

  std::unique_ptr<const Hdf5InUse> in_use_;
  std::filesystem::path path_;
  int file_ = 0;
  bool open_ = false;
};

enum class ComplexPart { real, imaginary };

/// Channel by channel: of receive and transmit, the last one fastest.
std::vector<double> components(const std::vector<ScatteringMatrix>& rows, ComplexPart which);
std::vector<double> flat(const std::vector<ChannelErrors>& rows);

}  // namespace raytube
