// Which wedges meet where.
#pragma once

#include <span>
#include <vector>

#include "mesh/features/wedges.h"
#include "mesh/model/point_tree.h"

namespace raytube {

/// Both ends of all wedges, by number: 2 wedge, or 2 wedge + 1 for its `end`. Keeps a reference to the wedges.
class WedgeEnds {
 public:
  explicit WedgeEnds(std::span<const Wedge> wedges);

  const Wedge& wedge(std::uint32_t end) const { return wedges_[end / 2]; }
  const dvec3& position(std::uint32_t end) const { return positions_[end]; }
  /// Along its wedge away from it.
  dvec3 direction(std::uint32_t end) const;
  /// The others within `distance` of it and so far along its wedge, of wedges that a wave sees for themselves; until the next
  /// call.
  std::span<const std::uint32_t> met_by(std::uint32_t end, double distance);

 private:
  std::span<const Wedge> wedges_;
  std::vector<dvec3> positions_;
  PointTree tree_;
  std::vector<std::uint32_t> met_;
};

}  // namespace raytube
