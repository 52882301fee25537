// Bodies of a target that are closed but for holes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/field.h"

namespace raytube {

/// A hole, by the border about it.
struct Hole {
  dvec3 middle{0.0};    // of its border, in the mesh's own coordinates [m]
  double border = 0.0;  // length [m]
  double area = 0.0;    // of a surface that closes it [m^2]
};

struct OpenBodies {
  std::size_t count = 0, holes = 0;
  double share = 0.0;           // of the target's surface
  std::uint32_t component = 0;  // with the largest hole
  double area = 0.0;            // of that component [m^2]
  Hole largest;
};

}  // namespace raytube
