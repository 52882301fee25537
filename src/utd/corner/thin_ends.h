// Ends of thin bodies between two sharp edges, as of wings.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/angle.h"
#include "mesh/features/wedges.h"

namespace raytube {

/// An end of a wedge: 2 wedge, or 2 wedge + 1 for its `end`.
using WedgeEnd = std::uint32_t;

/// A plane face across the end of a body, bounded by two lines of edges that meet at its two tips. At each tip a sharp edge of
/// the body ends. To waves along it the body is the sheet in its middle.
struct ThinEnd {
  struct Tip {
    dvec3 position;
    dvec3 sharp;                       // along the sharp edge, away from the tip
    std::vector<std::uint32_t> edges;  // the wedges of that, on which it bends by little, from the tip on
    double sharp_length;               // [m]
    dvec3 sharp_end;
  };
  std::array<Tip, 2> tips;
  std::array<std::vector<std::uint32_t>, 2> sides;  // the wedges of both lines
  std::array<dvec3, 2> towards;                     // from the middle of the face to either line, unit
  double thickness = 0.0;                           // mean width of the face [m]
  dvec3 outwards;                                   // its normal

  double length() const { return glm::distance(tips[0].position, tips[1].position); }
};

/// All of them, on conductors: faces that are at most a quarter as wide as long and upright on their neighbours within 30
/// degrees. Their lines bend by 15 degrees at most from piece to piece; both the angle at a tip and that of the metal at the
/// sharp edge are at most 60 degrees.
std::vector<ThinEnd> find_thin_ends(std::span<const Wedge> wedges);

}  // namespace raytube
