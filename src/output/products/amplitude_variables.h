// What netCDF files of profiles, images and centres have in common.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "imaging/window.h"
#include "output/netcdf/new_netcdf.h"

namespace raytube {

/// What the result says of itself, the window, and the lowest and highest frequency and angles of the sweep.
void describe_product(NewNetcdf& out, const StoredResult& result, const Window& window);

/// Lines to be drawn over a picture, from end to end in the mesh's coordinates; nothing without any. Needs labels of xyz.
void write_outline(NewNetcdf& out, const std::vector<std::array<dvec3, 2>>& lines);

/// S_re, S_im and sigma_dbsm of every channel over these axes; `coordinates`: other variables that say where a value is.
void write_amplitudes(NewNetcdf& out, std::vector<std::string> axes, const std::string& what, const std::string& coordinates,
                      const std::vector<ScatteringMatrix>& s);

}  // namespace raytube
