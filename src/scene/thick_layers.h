// Coats and sheets that have no room on the body that is made of them.
#pragma once

#include <cstdint>

#include "core/field.h"

namespace raytube {

struct ThickLayers {
  std::uint32_t material = 0, component = 0;
  double thickness = 0.0;   // of all its layers together [m]
  double width = 0.0;       // of the body: between two parallel planes; of an open surface, across it [m]
  bool closed = false;      // a body, not a surface
  bool both_sides = false;  // coats on opposite sides share it
  dvec3 middle{0.0};        // of the component's box, in the mesh's own coordinates [m]
};

}  // namespace raytube
