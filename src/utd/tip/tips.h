// Sharp tips of bodies: vertices about which a curved surface is a circular cone.
#pragma once

#include <span>
#include <vector>

#include "utd/surface/conical_tip.h"
#include "utd/surface/curved_target.h"

namespace raytube {

/// A corner of a facet at a tip.
struct TipFacet {
  std::uint32_t triangle;
  int corner;
};

struct Tip : ConicalTip {
  std::vector<TipFacet> facets;
};

/// Tips of closed perfect conductors, of half angles that tip_table.h has, in the order of their vertices.
std::vector<Tip> find_tips(const CurvedTarget& target);

}  // namespace raytube
