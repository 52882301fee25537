#include "sbr/curved/facing_triangles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sbr/visible/projected_face.h"

namespace raytube {

Bounds FacingTriangle::bounds() const {
  return {glm::min(glm::min(at[0], at[1]), at[2]), glm::max(glm::max(at[0], at[1]), at[2])};
}

// Neither the box's sides nor the triangle's separate them.
bool FacingTriangle::reaches(const Bounds& box) const {
  if (!bounds().overlaps(box, 0.0)) return false;
  const dvec2 middle = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
  const dvec2 s = at[1] - at[0], t = at[2] - at[0];
  const double sense = s.x * t.y - s.y * t.x > 0.0 ? 1.0 : -1.0;
  for (int c = 0; c < 3; ++c) {
    const dvec2 side = sense * (at[(c + 1) % 3] - at[c]), to = middle - at[c];
    if (side.x * to.y - side.y * to.x + std::abs(side.x) * half.y + std::abs(side.y) * half.x < 0.0) return false;
  }
  return true;
}

bool FacingTriangle::contains(const dvec2& p) const {
  int positive = 0, negative = 0;
  for (int c = 0; c < 3; ++c) {
    const dvec2 side = at[(c + 1) % 3] - at[c], to = p - at[c];
    const double turn = side.x * to.y - side.y * to.x, rounding = tie * glm::dot(side, side);
    positive += turn > rounding;
    negative += turn < -rounding;
  }
  return positive == 0 || negative == 0;
}

std::vector<FacingTriangle> facing_triangles(const TubeLook& look) {
  const TriangleMesh& mesh = look.faces.mesh();
  std::vector<dvec2> projected;
  for (const dvec3& r : mesh.vertices) projected.emplace_back(glm::dot(r, look.grid.u_hat), glm::dot(r, look.grid.v_hat));
  const double step = tie * mesh.radius;
  const auto place = [&](const Triangle& corners) {
    const dvec3 sum = mesh.vertices[corners[0]] + mesh.vertices[corners[1]] + mesh.vertices[corners[2]];
    const auto steps = [&](const dvec3& axis) { return std::llround(glm::dot(sum, axis) / step); };
    return std::array{steps(look.grid.u_hat), steps(look.grid.v_hat), steps(look.grid.direction)};
  };
  std::vector<std::pair<std::array<long long, 3>, FacingTriangle>> placed;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const double towards = glm::dot(mesh.patch_of(t).normal, look.grid.direction);
    if (towards > -edge_on && (towards < edge_on || mesh.closed(t))) continue;
    const Triangle& corners = mesh.triangles[t];
    placed.emplace_back(
        place(corners),
        FacingTriangle{t, look.smooth->region(t), {projected[corners[0]], projected[corners[1]], projected[corners[2]]}});
  }
  std::ranges::stable_sort(placed, {}, [](const auto& entry) { return entry.first; });
  std::vector<FacingTriangle> facing;
  for (auto& [at, triangle] : placed) facing.push_back(triangle);
  return facing;
}

}  // namespace raytube
