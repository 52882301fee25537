// Images of sweeps in space, for ParaView.
#pragma once

#include <filesystem>

#include "imaging/isar.h"

namespace raytube {

/// Image data (.vti) turned as the image's axes are: sigma of the four channels [dBsm], and complex amplitudes [m]. Opens on
/// sigma of VV.
void write_isar_vti(const std::filesystem::path& file, const IsarImage& image);

}  // namespace raytube
