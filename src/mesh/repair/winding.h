// Triangles wound alike across their edges, and the components that come of it.
#pragma once

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "mesh/model/geometry.h"

namespace raytube {

struct SeparateSoup {
  std::vector<Triangle> triangles;       // those given, with corners in copies of the vertices
  std::vector<std::uint32_t> vertex_of;  // copy -> vertex
};

/// Bodies that touch along edges, taken apart. Triangles stay together at an edge that has two of them, and, where more meet, in
/// pairs that turn their backs to one another with nothing in between: the two that bound a solid there, if the winding is right.
SeparateSoup separate_bodies(std::span<const dvec3> vertices, std::span<const Triangle> triangles);

/// A side of a component without a partner, in the mesh's own vertices; `sense` is +1 from low to high, -1 the other way.
struct BorderPiece {
  std::uint32_t component, low, high;
  int sense;
  auto key() const { return std::tie(component, low, high); }
};

/// Which triangles to turn over so that those of each component are wound alike; as a whole a component may be either way round.
struct Winding {
  std::vector<std::uint32_t> component;  // [triangle] numbered in order of their first triangles
  std::vector<bool> reversed;            // [triangle]
  std::vector<BorderPiece> border;       // in no particular order
};

/// Triangles are cut apart at edges where they cannot be one manifold of two sides.
Winding wind_alike(std::span<const dvec3> vertices, const SeparateSoup& soup);

/// Cuts the triangles of a soup apart so, winds them alike (CGAL; slow), and says of each whether it was turned over for that.
std::vector<bool> cut_and_wind(std::span<const dvec3> vertices, SeparateSoup& soup);

}  // namespace raytube
