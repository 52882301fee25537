// Where other wedges pass in front of a wedge: only there can a polygonal target's shadows begin or end on it.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "mesh/features/wedges.h"

namespace raytube {

/// All wedges in projection along one direction. The silhouette, those that can cast a shadow boundary, lies in a grid on the
/// plane across the direction.
class Crossings {
 public:
  /// `direction` is a unit vector from the target towards the viewpoint.
  Crossings(std::span<const Wedge> wedges, const dvec3& direction);

  /// Fills `fractions` (cleared first) with the crossings of wedge `index` by wedges of the silhouette that lie ahead of it along
  /// the direction, as fractions of its length from its start, in order.
  void find(std::uint32_t index, std::vector<double>& fractions) const;

 private:
  /// A wedge in projection; depth grows along the direction.
  struct Segment {
    dvec2 start, along;
    double length, start_depth, depth_change;

    double furthest() const { return start_depth + std::max(depth_change, 0.0); }
    double nearest() const { return start_depth + std::min(depth_change, 0.0); }
  };
  void fill_grid(std::span<const std::uint32_t> silhouette);
  std::size_t cell(const dvec2& point, int axis) const;
  template <class Visit>
  void visit_cells(const Segment& segment, std::size_t margin, Visit visit) const;

  std::vector<Segment> segments_;
  dvec2 low_{0.0}, cell_size_{1.0};
  std::size_t cells_ = 1;                      // on each side
  std::vector<std::uint32_t> first_, inside_;  // segments in each cell, compressed rows
};

}  // namespace raytube
