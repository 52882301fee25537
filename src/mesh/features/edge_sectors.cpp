#include "mesh/features/edge_sectors.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace raytube {

namespace {

/// Below this angle [rad] a sector is no space but the rounding between two faces that lie on one another.
constexpr double no_opening = 1e-9;

/// A triangle at an edge, as one looks along the edge from its lower vertex to its higher one.
struct Leaf {
  std::uint32_t patch;
  std::uint32_t triangle;
  bool forward;     // its winding runs from low to high: the front is its counter-clockwise side
  bool both_sides;  // exposed on its back too
  double angle;

  PatchSide counter_clockwise_side() const { return {patch, !forward}; }
  PatchSide clockwise_side() const { return {patch, forward}; }
  bool exposed(const PatchSide& side) const { return both_sides || !side.back; }
};

/// An edge stands on a patch it belongs to only if it is shorter than the distance by which patches are flat.
bool stands_on_patch(const TriangleMesh& mesh, const EdgeTable::Edge& edge, const dvec3& tangent) {
  return std::ranges::any_of(edge.sides, [&](const EdgeTable::Side& side) {
    return std::abs(glm::dot(mesh.patch_of(side.triangle).normal, tangent)) > 0.5;
  });
}

/// Fills `leaves` with those of an edge in order of angle, counted from the first triangle; equal angles in order of triangles.
/// None if the edge is too short to tell.
void sort_leaves(const TriangleMesh& mesh, const EdgeTable::Edge& edge, std::vector<Leaf>& leaves) {
  const dvec3 tangent = glm::normalize(mesh.vertices[edge.high] - mesh.vertices[edge.low]);
  leaves.clear();
  if (stands_on_patch(mesh, edge, tangent)) return;
  FaceFrame first{};
  for (const auto& [triangle, corner] : edge.sides) {
    const bool forward = mesh.triangles[triangle][corner] == edge.low;
    Leaf leaf{mesh.triangle_patch[triangle], triangle, forward, !mesh.closed(triangle), 0.0};
    const FaceFrame frame = face_frame(mesh, leaf.counter_clockwise_side(), tangent, 0);
    if (leaves.empty()) first = frame;
    if (!leaves.empty()) leaf.angle = opening(first, frame);
    leaves.push_back(leaf);
  }
  if (leaves.size() > 2)  // the first one's angle is 0
    std::stable_sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) { return a.angle < b.angle; });
}

/// One of the two ways to describe a sector, the same whatever the numbering of the vertices along a run.
EdgeSector in_standard_order(EdgeSector sector) {
  if (sector.faces[1] < sector.faces[0]) {
    std::swap(sector.faces[0], sector.faces[1]);
    std::swap(sector.start, sector.end);
  }
  return sector;
}

}  // namespace

FaceFrame face_frame(const TriangleMesh& mesh, const PatchSide& side, const dvec3& tangent, int index) {
  return face_frame((side.back ? -1.0 : 1.0) * mesh.patches[side.patch].normal, tangent, index);
}

FaceFrame face_frame(const dvec3& outward, const dvec3& tangent, int index) {
  const dvec3 normal = glm::normalize(outward - glm::dot(outward, tangent) * tangent);
  return {index == 0 ? glm::cross(normal, tangent) : glm::cross(tangent, normal), normal};
}

double opening(const FaceFrame& first, const FaceFrame& second) {
  const double angle = std::atan2(glm::dot(second.into_face, first.normal), glm::dot(second.into_face, first.into_face));
  return angle < 0.0 ? angle + 2.0 * pi : angle;
}

double refined_n(const FaceFrame& first, const FaceFrame& second, double n) {
  const double refined = opening(first, second) / pi;
  return refined + 2.0 * std::round((n - refined) / 2.0);
}

bool has_opening(const EdgeSector& sector) { return sector.n * pi > no_opening; }

bool is_wedge(const TriangleMesh& mesh, const EdgeSector& sector, double min_wedge_angle) {
  const double bend = std::abs(sector.n - 1.0) * pi;
  const Patch &first = mesh.patches[sector.faces[0].patch], &second = mesh.patches[sector.faces[1].patch];
  const bool same_plane = first.normal == second.normal && first.offset == second.offset;  // one patch, or cut by materials
  return !(same_plane && bend < no_opening) && has_opening(sector) && bend >= min_wedge_angle &&
         !mesh.is_bend(sector.start, sector.end);
}

std::vector<EdgeSector> exposed_sectors(const TriangleMesh& mesh, const std::function<bool(const EdgeSector&)>& takes) {
  const EdgeTable& edges = mesh.edges();
  std::vector<EdgeSector> sectors;
  std::vector<Leaf> leaves;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    sort_leaves(mesh, edges[e], leaves);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const bool last = i + 1 == leaves.size();
      const Leaf &from = leaves[i], &to = leaves[last ? 0 : i + 1];
      const PatchSide first = from.counter_clockwise_side(), second = to.clockwise_side();
      if (!from.exposed(first) || !to.exposed(second)) continue;
      const double angle = to.angle - from.angle + (last ? 2.0 * pi : 0.0);
      const EdgeSector sector = in_standard_order({{first, second}, edges[e].low, edges[e].high, angle / pi});
      if (takes(sector)) sectors.push_back(sector);
    }
  }
  return sectors;
}

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
