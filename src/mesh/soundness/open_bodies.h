// Surfaces that look like bodies with holes: rays enter them, and see their inside.
#pragma once

#include <span>
#include <vector>

#include "mesh/model/triangle_mesh.h"
#include "scene/material.h"
#include "scene/open_bodies.h"

namespace raytube {

/// Holes of less than this share of a component's area make it a body: those of a box without one face (1/5) and of a cone
/// without its base do; a plate, a dihedral (0.7), a trihedral (0.5), a dish (a half or more) and a short ring are open surfaces.
inline constexpr double most_hole_share = 1.0 / 3.0;

/// Those among the components that have a border and are reached from outside (not `enclosed`); without those that waves enter
/// anyway, through facets that transmit.
OpenBodies find_open_bodies(const TriangleMesh& mesh, const std::vector<bool>& enclosed, std::span<const Material> materials);

}  // namespace raytube
