// A wedge as a line with what is to be told of it: plain data, for lists and pictures.
#pragma once

#include <array>
#include <cstdint>

#include "core/field.h"

namespace raytube {

/// An edge of the target at which two faces meet.
struct WedgeLine {
  dvec3 start, end;                      // in the mesh's own coordinates [m]
  double length = 0.0;                   // [m]
  double interior_angle = 0.0;           // of the metal [rad]
  double n = 0.0;                        // exterior angle / pi
  std::array<std::uint32_t, 2> patches;  // of its two faces
  double lit_fraction = 0.0;             // of its length, by the transmitter of one look
  double thickness = 0.0;                // of the plate whose edge it is [m]; 0: a sharp edge
};

}  // namespace raytube
