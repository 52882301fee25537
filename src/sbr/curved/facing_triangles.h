// The triangles of a target that are turned to the radar, over the launch plane.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sbr/beams/tube_look.h"
#include "sbr/launch/convex_polygon.h"

namespace raytube {

/// What differs by less, of what is compared, is equal but for rounding: on bodies of some symmetry sides of facets run through
/// the middles of cells and of faces, and it must not be rounding that decides.
inline constexpr double tie = 1e-9;

/// A triangle turned to the radar, in launch coordinates.
struct FacingTriangle {
  std::uint32_t triangle;
  std::uint32_t region;  // the curved surface it is part of; no_index: it is flat
  std::array<dvec2, 3> at;

  Bounds bounds() const;
  bool reaches(const Bounds& box) const;
  bool contains(const dvec2& p) const;
};

/// Those of a look. Of facets that would do as well the first one counts, so their order hangs on their places, whatever that of
/// the mesh is.
std::vector<FacingTriangle> facing_triangles(const TubeLook& look);

}  // namespace raytube
