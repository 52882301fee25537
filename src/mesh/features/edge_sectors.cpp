#include "mesh/features/edge_sectors.h"

#include <algorithm>
#include <cmath>

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
  const dvec3 outward = (side.back ? -1.0 : 1.0) * mesh.patches[side.patch].normal;
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

}  // namespace raytube
