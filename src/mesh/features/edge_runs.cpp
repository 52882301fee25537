#include <algorithm>
#include <map>
#include <tuple>

#include "mesh/features/edge_sectors.h"

namespace raytube {

namespace {

using Vertex = std::uint32_t EdgePiece::*;

auto key(const EdgePiece& piece, Vertex vertex) { return std::tuple(piece.faces[0], piece.faces[1], piece.*vertex); }

/// Pieces with the same faces, each followed by the one that starts where it ends, unless there are several.
class Chains {
 public:
  explicit Chains(std::span<const EdgePiece> pieces) : next_(pieces.size(), no_index), previous_(pieces.size(), no_index) {
    std::vector<std::uint32_t> by_start = sorted(pieces, &EdgePiece::start), by_end = sorted(pieces, &EdgePiece::end);
    std::size_t first = 0;
    for (std::size_t i = 0; i < by_end.size(); ++i) {
      const auto here = key(pieces[by_end[i]], &EdgePiece::end);
      while (first < by_start.size() && key(pieces[by_start[first]], &EdgePiece::start) < here) ++first;
      if (alone(pieces, by_end, i, &EdgePiece::end) && first < by_start.size() &&
          key(pieces[by_start[first]], &EdgePiece::start) == here && alone(pieces, by_start, first, &EdgePiece::start)) {
        next_[by_end[i]] = by_start[first];
        previous_[by_start[first]] = by_end[i];
      }
    }
  }

  std::uint32_t next(std::uint32_t piece) const { return next_[piece]; }
  std::uint32_t previous(std::uint32_t piece) const { return previous_[piece]; }

 private:
  static std::vector<std::uint32_t> sorted(std::span<const EdgePiece> pieces, Vertex vertex) {
    std::vector<std::uint32_t> order(pieces.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return key(pieces[a], vertex) < key(pieces[b], vertex); });
    return order;
  }

  static bool alone(std::span<const EdgePiece> pieces, std::span<const std::uint32_t> order, std::size_t i, Vertex vertex) {
    const auto here = key(pieces[order[i]], vertex);
    return (i == 0 || key(pieces[order[i - 1]], vertex) != here) &&
           (i + 1 == order.size() || key(pieces[order[i + 1]], vertex) != here);
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

std::vector<EdgePiece> join_straight(std::span<const dvec3> vertices, std::vector<EdgePiece> pieces, double distance) {
  const Chains chains(pieces);
  std::vector<bool> done(pieces.size(), false);
  std::vector<EdgePiece> runs;
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    if (done[i]) continue;
    std::uint32_t head = i;
    while (chains.previous(head) != no_index && chains.previous(head) != i) head = chains.previous(head);
    if (chains.previous(head) == i) head = i;  // a loop

    std::vector<std::uint32_t> path{pieces[head].start};
    for (std::uint32_t p = head; p != no_index && !done[p]; p = chains.next(p)) {
      done[p] = true;
      path.push_back(pieces[p].end);
    }
    if (path.front() == path.back()) path = from_a_corner(vertices, std::move(path));
    for (std::size_t first = 0; first + 1 < path.size();) {
      const std::size_t last = straight_end(vertices, path, first, distance);
      runs.push_back({pieces[head].faces, path[first], path[last], pieces[head].n});
      first = last;
    }
  }
  return runs;
}

}  // namespace raytube
