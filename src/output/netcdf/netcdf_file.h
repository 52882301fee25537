// Results as netCDF-4 files, which MATLAB, Octave, xarray, h5py and ParaView open. Dimensions and variables:
// docs/reference/files.md.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "output/netcdf/stored_result.h"

namespace raytube {

/// True for a name that ends with .nc, in small or capital letters.
bool is_netcdf_name(const std::filesystem::path& file);

/// Writes everything that the result holds: equal results give equal bytes. Attributes without text are left out. Throws
/// std::runtime_error if the disk does not take it: the file must not be used then. May be called from any thread, but nobody
/// else may use the HDF5 library meanwhile.
void write_netcdf(const std::filesystem::path& file, const StoredResult& result);

/// Reads what write_netcdf wrote, bit for bit. Throws InputError if the file cannot be read or holds something else.
StoredResult read_netcdf(const std::filesystem::path& file);

/// The length of a dimension, 0 where there is none: `cross_range_m` tells an image from a result. Throws InputError if the file
/// cannot be read.
std::size_t netcdf_dimension(const std::filesystem::path& file, const char* name);

}  // namespace raytube
