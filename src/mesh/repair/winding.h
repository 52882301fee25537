// Triangles wound alike across their edges, and the components that come of it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "mesh/repair/separate.h"

namespace raytube {

/// A side of a component without a partner, in the mesh's own vertices; `sense` is +1 from low to high, -1 the other way.
struct BorderPiece {
  std::uint32_t component, low, high;
  int sense;
  auto key() const { return std::tie(component, low, high); }
};

/// Which triangles to turn over so that those of each component are wound alike; as a whole a component may be either way round.
struct Winding {
  std::vector<std::uint32_t> component;  // [triangle]
  std::vector<bool> reversed;            // [triangle]
  std::vector<BorderPiece> border;       // in no particular order
};

/// Of triangles of which no more than two meet at an edge and which have two sides; nothing for others.
std::optional<Winding> manifold_winding(const SeparateSoup& soup);

/// Of any triangles, cut apart at edges where they cannot be one manifold (CGAL): slower.
Winding cut_winding(std::span<const dvec3> vertices, const SeparateSoup& soup);

}  // namespace raytube
