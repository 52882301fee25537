// Finds the vertices near a segment.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/model/geometry.h"

namespace raytube {

/// A tree of bounding boxes over some of the vertices.
class PointTree {
 public:
  PointTree(std::span<const dvec3> points, std::vector<std::uint32_t> members);

  /// Appends the members within `distance` of the segment, in no particular order.
  void near_segment(const dvec3& a, const dvec3& b, double distance, std::vector<std::uint32_t>& found) const;

 private:
  struct Node {
    Box box;
    std::uint32_t begin, end;  // members
    std::uint32_t right = 0;   // second child, the first one follows its parent; 0 in leaves
  };

  void build(std::uint32_t begin, std::uint32_t end);

  std::span<const dvec3> points_;
  std::vector<std::uint32_t> members_;
  std::vector<Node> nodes_;
};

/// Distance of a point from the segment a-b.
double distance_to_segment(const dvec3& p, const dvec3& a, const dvec3& b);

}  // namespace raytube
