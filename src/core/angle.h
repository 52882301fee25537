// Angles between vectors.
#pragma once

#include <cmath>

#include "core/field.h"

namespace raytube {

/// 0 to pi [rad], with all digits at either end.
inline double angle_between(const dvec3& a, const dvec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

}  // namespace raytube
