// What a surface does to a wave. Only the perfect conductor in this version; other materials answer the same two questions.
#pragma once

#include "field.h"

namespace raytube {

/// Unit propagation direction after specular reflection at a plane of unit normal n.
inline dvec3 reflected_direction(const dvec3& d, const dvec3& n) { return d - 2.0 * glm::dot(d, n) * n; }

/// Electric field after reflection at a perfect conductor: E_r = -E + 2 (n.E) n  (tangential E vanishes on the surface).
inline dvec3 reflected_field_pec(const dvec3& e, const dvec3& n) { return 2.0 * glm::dot(n, e) * n - e; }

/// eta J on a perfect conductor lit by a plane wave: J = 2 n x H, eta H = d x E; n points to the side of the source.
inline dvec3 surface_current_pec(const dvec3& d, const dvec3& e, const dvec3& n) { return 2.0 * glm::cross(n, glm::cross(d, e)); }

}  // namespace raytube
