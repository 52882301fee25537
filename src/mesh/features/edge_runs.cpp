#include <algorithm>
#include <map>
#include <tuple>

#include "mesh/features/edge_sectors.h"

namespace raytube {

namespace {

using Vertex = std::uint32_t EdgeSector::*;

auto key(const EdgeSector& sector, Vertex vertex) { return std::tuple(sector.faces[0], sector.faces[1], sector.*vertex); }

/// Pieces with the same faces, each followed by the one that starts where it ends, unless there are several.
class Chains {
 public:
  explicit Chains(std::span<const EdgeSector> sectors) : next_(sectors.size(), no_index), previous_(sectors.size(), no_index) {
    std::vector<std::uint32_t> by_start = sorted(sectors, &EdgeSector::start), by_end = sorted(sectors, &EdgeSector::end);
    std::size_t first = 0;
    for (std::size_t i = 0; i < by_end.size(); ++i) {
      const auto here = key(sectors[by_end[i]], &EdgeSector::end);
      while (first < by_start.size() && key(sectors[by_start[first]], &EdgeSector::start) < here) ++first;
      if (alone(sectors, by_end, i, &EdgeSector::end) && first < by_start.size() &&
          key(sectors[by_start[first]], &EdgeSector::start) == here && alone(sectors, by_start, first, &EdgeSector::start)) {
        next_[by_end[i]] = by_start[first];
        previous_[by_start[first]] = by_end[i];
      }
    }
  }

  std::uint32_t next(std::uint32_t sector) const { return next_[sector]; }
  std::uint32_t previous(std::uint32_t sector) const { return previous_[sector]; }

 private:
  static std::vector<std::uint32_t> sorted(std::span<const EdgeSector> sectors, Vertex vertex) {
    std::vector<std::uint32_t> order(sectors.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return key(sectors[a], vertex) < key(sectors[b], vertex); });
    return order;
  }

  static bool alone(std::span<const EdgeSector> sectors, std::span<const std::uint32_t> order, std::size_t i, Vertex vertex) {
    const auto here = key(sectors[order[i]], vertex);
    return (i == 0 || key(sectors[order[i - 1]], vertex) != here) &&
           (i + 1 == order.size() || key(sectors[order[i + 1]], vertex) != here);
  }

  std::vector<std::uint32_t> next_, previous_;
};

/// The vertices from `first` to `last` lie on the line between these two, in this order.
bool is_straight(std::span<const dvec3> vertices, std::span<const std::uint32_t> path, std::size_t first, std::size_t last,
                 double distance) {
  const dvec3 start = vertices[path[first]], along = vertices[path[last]] - start;
  const double length = glm::length(along);
  double reached = 0.0;
  for (std::size_t i = first + 1; i <= last; ++i) {
    const dvec3 offset = vertices[path[i]] - start;
    const double here = glm::dot(offset, along) / length;
    if (!(here > reached) || glm::length(glm::cross(offset, along)) > distance * length) return false;
    reached = here;
  }
  return true;
}

/// The end of the longest straight run from `first`: doubling steps, then halving ones, so that long runs stay cheap.
std::size_t straight_end(std::span<const dvec3> vertices, std::span<const std::uint32_t> path, std::size_t first,
                         double distance) {
  const std::size_t last = path.size() - 1;
  std::size_t reached = first + 1, step = 1;
  const auto extend = [&] {
    if (reached + step > last || !is_straight(vertices, path, first, reached + step, distance)) return false;
    reached += step;
    return true;
  };
  while (extend()) step *= 2;
  for (; step > 0; step /= 2) extend();
  return reached;
}

/// Turns a closed path so that it starts at a corner: the vertex farthest from any given point is one.
std::vector<std::uint32_t> from_a_corner(std::span<const dvec3> vertices, std::vector<std::uint32_t> loop) {
  loop.pop_back();  // equal to the first
  const dvec3 origin = vertices[*std::min_element(loop.begin(), loop.end())];
  const auto corner = std::max_element(loop.begin(), loop.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double to_a = glm::distance(vertices[a], origin), to_b = glm::distance(vertices[b], origin);
    return to_a != to_b ? to_a < to_b : a > b;
  });
  std::rotate(loop.begin(), corner, loop.end());
  loop.push_back(loop.front());
  return loop;
}

}  // namespace

std::vector<EdgeSector> join_straight(std::span<const dvec3> vertices, std::vector<EdgeSector> sectors, double distance) {
  const Chains chains(sectors);
  std::vector<bool> done(sectors.size(), false);
  std::vector<EdgeSector> runs;
  for (std::uint32_t i = 0; i < sectors.size(); ++i) {
    if (done[i]) continue;
    std::uint32_t head = i;
    while (chains.previous(head) != no_index && chains.previous(head) != i) head = chains.previous(head);
    if (chains.previous(head) == i) head = i;  // a loop

    std::vector<std::uint32_t> path{sectors[head].start};
    for (std::uint32_t p = head; p != no_index && !done[p]; p = chains.next(p)) {
      done[p] = true;
      path.push_back(sectors[p].end);
    }
    if (path.front() == path.back()) path = from_a_corner(vertices, std::move(path));
    for (std::size_t first = 0; first + 1 < path.size();) {
      const std::size_t last = straight_end(vertices, path, first, distance);
      runs.push_back({sectors[head].faces, path[first], path[last], sectors[head].n});
      first = last;
    }
  }
  return runs;
}

}  // namespace raytube
