// Where other wedges pass in front of a wedge: the only places where a polygonal target's shadows can begin or end on it.
#pragma once

#include <span>
#include <vector>

#include "mesh/wedges.h"

namespace raytube {

/// All wedges seen from one direction, in a grid on the plane across it.
class Crossings {
 public:
  Crossings(std::span<const Wedge> wedges, const dvec3& direction);

  /// Fills `places` (cleared first) with the crossings of wedge `index` by wedges that lie ahead of it along the direction, as
  /// fractions of its length from its start, in order.
  void find(std::uint32_t index, std::vector<double>& places) const;

 private:
  /// A wedge in projection; depth grows along the direction.
  struct Segment {
    dvec2 start, end;
    double start_depth, end_depth;
  };
  std::size_t cell(const dvec2& point, int axis) const;
  template <class Visit>
  void visit_cells(const Segment& segment, Visit visit) const;

  std::vector<Segment> segments_;
  dvec2 low_{0.0}, cell_size_{1.0};
  std::size_t cells_ = 1;  // on each side
  std::vector<std::vector<std::uint32_t>> grid_;
};

}  // namespace raytube
