#include "mesh/features/outlines.h"

#include <cmath>
#include <limits>
#include <utility>

#include "mesh/features/edge_sectors.h"

namespace raytube {

namespace {

constexpr double parallel = 1e-9;        // of the direction's component across an edge: the line never reaches it
constexpr double behind = 1e-12;         // of the edge's length: a line that starts on an edge has crossed it
constexpr double vertex_overlap = 1e-7;  // of the edge's length: neighbours overlap, so that no line slips through a vertex

std::size_t side_index(std::uint32_t patch, bool back) { return 2 * std::size_t{patch} + (back ? 1 : 0); }

/// Distance along the line to the edge, or infinity if it does not cross the edge outwards nearer than `limit`.
double crossing(const OutlineEdge& edge, const dvec3& point, const dvec3& direction, double limit) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const double inwards = glm::dot(direction, edge.into_face);
  if (inwards > -parallel) return never;
  const dvec3 offset = point - edge.start;
  const double distance = -glm::dot(offset, edge.into_face) / inwards;
  if (distance < -behind * edge.length || distance >= limit) return never;
  const double share = glm::dot(offset + distance * direction, edge.share);
  return share < -vertex_overlap || share > 1.0 + vertex_overlap ? never : std::max(distance, 0.0);
}

}  // namespace

Outlines::Outlines(const TriangleMesh& mesh, std::span<const Wedge> wedges, double min_wedge_angle) {
  for (const Wedge& wedge : wedges)
    if (wedge.stands_alone())
      for (const WedgeFace& face : wedge.faces) edges_.try_emplace(side_index(face.patch, face.back));
  add_wedges(wedges);
  add_creases(mesh, min_wedge_angle);
  for (auto& [side, around] : edges_) around.shrink_to_fit();
}

void Outlines::add(std::size_t side, const OutlineEdge& edge) {
  const auto around = edges_.find(side);
  if (around == edges_.end()) return;
  OutlineEdge& added = around->second.emplace_back(edge);
  if (edge.wedge_face == 1) std::swap(added.start, added.end);
  const dvec3 along = added.end - added.start;
  added.share = along / glm::dot(along, along);
  added.length = glm::length(along);
}

/// Currents end beside other materials than perfect conductors: as far as they know there is no wedge. An edge of a thin plate's
/// border face stays where it is in the outlines; what stands there is the half plane, and nothing on the border face's side.
void Outlines::add_wedge(std::span<const Wedge> wedges, std::uint32_t wedge, int face) {
  const Wedge& w = wedges[wedge];
  const std::size_t side = side_index(w.faces[face].patch, w.faces[face].back);
  const std::uint32_t any = w.flat ? no_index : wedge, there = w.conducting() || w.is_border() ? any : no_index;
  add(side, {w.start, w.end, w.faces[face].into_face, there, any, face, w.flat});
  const auto around = edges_.find(side);
  if (w.replaced_by == no_index || around == edges_.end()) return;
  OutlineEdge& edge = around->second.back();
  edge.wedge = edge.any_wedge = no_index;
  for (int i = 0; i < 2; ++i) {
    const WedgeFace& own = wedges[w.replaced_by].faces[i];
    if (side_index(own.patch, own.back) != side) continue;
    edge.any_wedge = w.replaced_by;
    if (wedges[w.replaced_by].conducting()) edge.wedge = w.replaced_by;
    edge.wedge_face = i;
  }
}

void Outlines::add_wedges(std::span<const Wedge> wedges) {
  for (std::uint32_t w = 0; w < wedges.size(); ++w)
    for (int i = 0; i < 2; ++i)
      if (wedges[w].thickness() == 0.0) add_wedge(wedges, w, i);
}

/// What is left of the outlines once the wedges are taken: flat creases, and faces that touch with no space between them.
void Outlines::add_creases(const TriangleMesh& mesh, double min_wedge_angle) {
  if (edges_.empty()) return;
  std::vector<EdgeSector> sectors = exposed_sectors(mesh, [&](const EdgeSector& sector) {
    const auto wanted = [&](const PatchSide& side) { return edges_.contains(side_index(side.patch, side.back)); };
    return (wanted(sector.faces[0]) || wanted(sector.faces[1])) && sector.faces[0] != sector.faces[1] &&
           !is_wedge(mesh, sector, min_wedge_angle);
  });
  const double distance = flat_fraction * bounding_box(mesh.vertices).diagonal();
  for (const EdgeSector& run : join_straight(mesh.vertices, std::move(sectors), distance)) {
    const dvec3 start = mesh.vertices[run.start], end = mesh.vertices[run.end], tangent = glm::normalize(end - start);
    for (int i = 0; i < 2; ++i) {
      const dvec3 into_face = face_frame(mesh, run.faces[i], tangent, i).into_face;
      add(side_index(run.faces[i].patch, run.faces[i].back), {start, end, into_face, no_index, no_index, i, has_opening(run)});
    }
  }
}

std::span<const OutlineEdge> Outlines::around(const WedgeFace& face) const {
  const auto found = edges_.find(side_index(face.patch, face.back));
  return found == edges_.end() ? std::span<const OutlineEdge>() : found->second;
}

FaceExit Outlines::exit(const WedgeFace& face, std::uint32_t own, const dvec3& point, const dvec3& direction) const {
  FaceExit nearest{nullptr, std::numeric_limits<double>::infinity()};
  for (const OutlineEdge& edge : around(face)) {
    if (edge.wedge == own) continue;
    const double distance = crossing(edge, point, direction, nearest.distance);
    if (distance < nearest.distance) nearest = {&edge, distance};
  }
  return nearest;
}

}  // namespace raytube
