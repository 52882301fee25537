// Parts of a target that nothing from outside can reach.
#pragma once

#include <vector>

#include "mesh/features/wedges.h"
#include "mesh/model/face_tree.h"

namespace raytube {

/// For each component of the mesh, whether it lies inside a closed one without touching it: waves from outside never get there,
/// straight or reflected. Parts that come near the surface of the body count as reachable.
std::vector<bool> find_enclosed_components(const FaceTree& tree);

/// Marks the wedges of the components for which `components` holds (Wedge::enclosed). Returns how many of those that conduct it
/// has newly marked.
std::uint64_t mark_enclosed(const TriangleMesh& mesh, const std::vector<bool>& components, std::vector<Wedge>& wedges);

}  // namespace raytube
