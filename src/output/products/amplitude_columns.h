// Columns that tables of profiles, images and centres have in common.
#pragma once

#include <string>

#include "core/field.h"

namespace raytube {

/// ",re_vv,im_vv, ... ,sigma_vv_dbsm, ..."
std::string amplitude_columns();

/// What stands under them, amplitudes [m] to so many digits.
std::string amplitudes_text(const ScatteringMatrix& s, int digits);

}  // namespace raytube
