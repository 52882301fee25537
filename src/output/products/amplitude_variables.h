// Variables that netCDF files of profiles and images have in common.
#pragma once

#include <string>
#include <vector>

#include "output/netcdf/new_netcdf.h"

namespace raytube {

/// S_re, S_im and sigma_dbsm of every channel over these axes; `coordinates`: other variables that say where a value is.
void write_amplitudes(NewNetcdf& out, std::vector<std::string> axes, const std::string& what, const std::string& coordinates,
                      const std::vector<ScatteringMatrix>& s);

}  // namespace raytube
