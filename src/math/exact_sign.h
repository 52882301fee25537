// Which side of a line another line passes, without rounding.
#pragma once

#include "core/field.h"

namespace raytube {

/// Sign of direction . ((a - origin) x (b - origin)), exact for any finite numbers as given.
int exact_side(const dvec3& direction, const dvec3& origin, const dvec3& a, const dvec3& b);

}  // namespace raytube
