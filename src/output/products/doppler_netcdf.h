// Range-Doppler maps, spectrograms and the cube of data behind them as netCDF.
#pragma once

#include <filesystem>

#include "imaging/doppler.h"
#include "output/netcdf/stored_result.h"

namespace raytube {

/// What doppler.csv has, in every digit, with what `result`, which the map was made of, says of itself. Throws as write_netcdf
/// does.
void write_doppler_netcdf(const std::filesystem::path& file, const StoredResult& result, const DopplerMap& map,
                          const Window& window);

/// What spectrogram.csv has, likewise.
void write_spectrogram_netcdf(const std::filesystem::path& file, const StoredResult& result, const Spectrogram& spectrogram,
                              const Window& window);

/// raw.nc: S [pulse, frequency, receiver, receive, transmit] [m] with the times of pulses [s] and, of antennas at a finite
/// distance, their places in the mesh's coordinates [pulse, receiver, xyz] [m], of others the unit vectors towards them. A
/// receiver is a look of a pulse. Throws InputError that begins with `what` as pulse_grid does, and as write_netcdf does.
void write_raw_netcdf(const std::filesystem::path& file, const StoredResult& result, const std::string& what);

}  // namespace raytube
