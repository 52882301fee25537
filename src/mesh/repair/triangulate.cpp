#include "mesh/repair/triangulate.h"

#include <algorithm>
#include <set>
#include <unordered_map>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

namespace {

/// The corners that are left of a polygon, in a tree of boxes in its plane.
class CornersLeft {
 public:
  CornersLeft(const PlanarRing& plane, const Ring& ring) : plane_(plane), members_(ring) {
    for (const std::uint32_t p : ring) {
      ++times_[p];
      size_ = std::max({size_, std::abs(plane.at(p).x), std::abs(plane.at(p).y)});
    }
    std::ranges::sort(members_);
    members_.erase(std::unique(members_.begin(), members_.end()), members_.end());
    build(0, static_cast<std::uint32_t>(members_.size()));
    for (std::uint32_t i = 0; i < members_.size(); ++i) position_[members_[i]] = i;
  }

  /// True if the ring does not pass this corner any more.
  bool drop(std::uint32_t p) {
    if (--times_[p] > 0) return false;
    const std::uint32_t position = position_[p];
    for (std::uint32_t at = 0;;) {
      Node& node = nodes_[at];
      --node.left;
      if (node.right == 0) return true;
      at = position < nodes_[node.right].begin ? at + 1 : node.right;
    }
  }

  /// A corner in the triangle that is none of its own; no_index if there is none.
  std::uint32_t one_in(const Triangle& t) const { return one_in(t, 0); }

 private:
  struct Node {
    dvec2 low, high;
    std::uint32_t begin, end, left;  // members, and how many of them are left
    std::uint32_t right = 0;         // second child, the first one follows its parent; 0 in leaves
  };

  void build(std::uint32_t begin, std::uint32_t end) {
    const std::size_t at = nodes_.size();
    Node node{plane_.at(members_[begin]), plane_.at(members_[begin]), begin, end, end - begin};
    for (std::uint32_t i = begin; i < end; ++i) {
      node.low = glm::min(node.low, plane_.at(members_[i]));
      node.high = glm::max(node.high, plane_.at(members_[i]));
    }
    nodes_.push_back(node);
    if (end - begin <= 8) return;
    const int axis = node.high.x - node.low.x >= node.high.y - node.low.y ? 0 : 1;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::ranges::nth_element(members_.begin() + begin, members_.begin() + middle, members_.begin() + end, {},
                             [&](std::uint32_t p) { return std::pair(plane_.at(p)[axis], p); });
    build(begin, middle);
    nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
    build(middle, end);
  }

  std::uint32_t one_in(const Triangle& t, std::uint32_t at) const {
    const Node& node = nodes_[at];
    if (node.left == 0 || is_outside(node, t)) return no_index;
    if (node.right != 0) {
      const std::uint32_t found = one_in(t, at + 1);
      return found != no_index ? found : one_in(t, node.right);
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const std::uint32_t p = members_[i];
      if (times_.at(p) > 0 && std::ranges::find(t, p) == t.end() && plane_.holds(t, p)) return p;
    }
    return no_index;
  }

  // All of the box lies beyond one side, by more than rounding.
  bool is_outside(const Node& node, const Triangle& t) const {
    for (int k = 0; k < 3; ++k) {
      const dvec2 from = plane_.at(t[k]), along = plane_.at(t[(k + 1) % 3]) - from;
      const dvec2 nearest(along.y > 0.0 ? node.low.x : node.high.x, along.x > 0.0 ? node.high.y : node.low.y);
      const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * size_ * (std::abs(along.x) + std::abs(along.y));
      if (along.x * (nearest.y - from.y) - along.y * (nearest.x - from.x) < -rounding) return true;
    }
    return false;
  }

  const PlanarRing& plane_;
  Ring members_;  // each once
  double size_ = 0.0;
  std::unordered_map<std::uint32_t, std::uint32_t> times_, position_;  // that the ring passes a corner; among the members
  std::vector<Node> nodes_;
};

/// A position of the ring that turned out to be no ear is asked again only when a neighbour has gone, or what was in its way.
class EarCutter {
 public:
  EarCutter(const PlanarRing& plane, const Ring& ring) : plane_(plane), ring_(ring), corners_(plane, ring) {
    const auto size = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t position = 0; position < size; ++position) {
      before_.push_back((position + size - 1) % size);
      after_.push_back((position + 1) % size);
      possible_.insert(possible_.end(), position);
    }
  }

  std::vector<Triangle> run() {
    std::vector<Triangle> triangles;
    std::uint32_t start = 0;
    for (std::size_t left = ring_.size(); left > 3; --left) {
      const std::uint32_t position = next_ear(start);
      triangles.push_back(triangle_at(position));
      start = after_[after_[position]];
      cut(position);
    }
    const auto first = static_cast<std::uint32_t>(std::ranges::find(gone_, false) - gone_.begin());
    triangles.push_back({ring_[first], ring_[after_[first]], ring_[before_[first]]});
    return triangles;
  }

 private:
  Triangle triangle_at(std::uint32_t position) const {
    return {ring_[before_[position]], ring_[position], ring_[after_[position]]};
  }

  // From `start` on, round the ring; `start` itself if there is none.
  std::uint32_t next_ear(std::uint32_t start) {
    for (auto at = possible_.lower_bound(start); !possible_.empty();) {
      if (at == possible_.end()) at = possible_.begin();
      if (is_ear(*at)) return *at;
      at = possible_.erase(at);
    }
    return start;
  }

  bool is_ear(std::uint32_t position) {
    const Triangle ear = triangle_at(position);
    if (!(plane_.turn(ear[0], ear[1], ear[2]) > 0.0)) return false;
    const std::uint32_t in_the_way = corners_.one_in(ear);
    if (in_the_way != no_index) waiting_[in_the_way].push_back(position);
    return in_the_way == no_index;
  }

  void cut(std::uint32_t position) {
    gone_[position] = true;
    possible_.erase(position);
    after_[before_[position]] = after_[position];
    before_[after_[position]] = before_[position];
    possible_.insert({before_[position], after_[position]});
    if (!corners_.drop(ring_[position])) return;
    for (const std::uint32_t other : waiting_[ring_[position]])
      if (!gone_[other]) possible_.insert(other);
    waiting_.erase(ring_[position]);
  }

  const PlanarRing& plane_;
  const Ring& ring_;
  CornersLeft corners_;
  std::vector<std::uint32_t> before_, after_;  // positions
  std::vector<bool> gone_ = std::vector<bool>(ring_.size(), false);
  std::set<std::uint32_t> possible_;                                       // positions
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> waiting_;  // of positions, by the corner in their way
};

void drop_repeated_corners(Ring& ring) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
}

bool has_three_distinct(Ring ring) {
  std::sort(ring.begin(), ring.end());
  return std::unique(ring.begin(), ring.end()) - ring.begin() >= 3;
}

std::vector<Triangle> fan(const Ring& ring) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 2; i < ring.size(); ++i) triangles.push_back({ring[0], ring[i - 1], ring[i]});
  return triangles;
}

/// Every triangle of the fan has the polygon's own sense of rotation and is no sliver: true for convex polygons without
/// corners on their sides, and for some others.
bool fan_covers(const PlanarRing& plane, const Ring& ring) {
  for (std::size_t i = 2; i < ring.size(); ++i)
    if (plane.angle(ring[0], ring[i - 1], ring[i]) < 1e-6) return false;
  return true;
}

}  // namespace

std::vector<Triangle> cut_ears(const PlanarRing& plane, const Ring& ring) { return EarCutter(plane, ring).run(); }

std::vector<Triangle> triangulate(std::span<const dvec3> points, Ring polygon) {
  drop_repeated_corners(polygon);
  if (!has_three_distinct(polygon)) return {};
  if (polygon.size() == 3) return {{polygon[0], polygon[1], polygon[2]}};
  const PlanarRing plane(points, polygon);
  return fan_covers(plane, polygon) ? fan(polygon) : cut_ears(plane, polygon);
}

}  // namespace raytube
