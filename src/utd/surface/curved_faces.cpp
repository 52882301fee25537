#include "utd/surface/curved_faces.h"

#include <algorithm>

#include "utd/wedge/rounding_guard.h"

namespace raytube {

namespace {

std::size_t key_of(std::uint32_t triangle, int corner, bool back) {
  return 2 * (3 * std::size_t{triangle} + static_cast<std::size_t>(corner)) + (back ? 1 : 0);
}

}  // namespace

CurvedFaces::CurvedFaces(const CurvedTarget& curved, std::span<const Wedge> wedges) : target_(curved), sides_(2 * wedges.size()) {
  for (const Wedge& wedge : wedges) lines_.push_back({wedge.start, (wedge.end - wedge.start) / wedge.length()});
  const TriangleMesh& mesh = curved.tracer.mesh();
  std::vector<std::vector<WedgeSide>> of_patch(mesh.patches.size());
  for (std::uint32_t w = 0; w < wedges.size(); ++w)
    for (int f = 0; f < 2 && wedges[w].replaced_by == no_index; ++f)
      if (wedges[w].faces[f].patch != no_index) of_patch[wedges[w].faces[f].patch].push_back({w, f});
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (curved.surfaces.region(t) == no_index) continue;
    for (int c = 0; c < 3; ++c)
      if (curved.surfaces.on_boundary(t, c)) find_sides(t, c, wedges, of_patch[mesh.triangle_patch[t]]);
  }
}

void CurvedFaces::find_sides(std::uint32_t triangle, int corner, std::span<const Wedge> wedges,
                             std::span<const WedgeSide> of_patch) {
  const TriangleMesh& mesh = target_.tracer.mesh();
  const Triangle& t = mesh.triangles[triangle];
  const dvec3 &a = mesh.vertices[t[corner]], &b = mesh.vertices[t[(corner + 1) % 3]];
  const double rounding = rounding_guard * mesh.radius;
  for (const WedgeSide& side : of_patch) {
    const Wedge& wedge = wedges[side.wedge];
    const Line& line = lines_[side.wedge];
    const auto lies_on = [&](const dvec3& point) {
      const double s = line.arc_length(point);
      return s >= -rounding && s <= wedge.length() + rounding && glm::distance(point, line.start + s * line.along) < rounding;
    };
    if (!lies_on(a) || !lies_on(b)) continue;
    const auto [begin, end] = std::minmax({line.arc_length(a), line.arc_length(b)});
    sides_[2 * std::size_t{side.wedge} + side.face].push_back({triangle, corner, begin, end});
    wedge_at_.try_emplace(key_of(triangle, corner, wedge.faces[side.face].back), side);
  }
}

std::optional<FacetPoint> CurvedFaces::at(std::uint32_t wedge, int face, const dvec3& point) const {
  const Line& line = lines_[wedge];
  const double s = line.arc_length(point);
  for (const FacetSide& side : sides_[2 * std::size_t{wedge} + face]) {
    if (s < side.begin || s > side.end) continue;
    const TriangleMesh& mesh = target_.tracer.mesh();
    const Triangle& t = mesh.triangles[side.triangle];
    const double from = line.arc_length(mesh.vertices[t[side.corner]]);
    const double share = std::abs(s - from) / (side.end - side.begin);
    double l[3] = {};
    l[side.corner] = 1.0 - share;
    l[(side.corner + 1) % 3] = share;
    return FacetPoint{side.triangle, {l[1], l[2]}};
  }
  return std::nullopt;
}

WedgeSide CurvedFaces::at(std::uint32_t triangle, int corner, bool back) const {
  const auto found = wedge_at_.find(key_of(triangle, corner, back));
  return found == wedge_at_.end() ? WedgeSide{} : found->second;
}

}  // namespace raytube
