#include "utd/tip/tips.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/angle.h"
#include "utd/tip/tip_table.h"

namespace raytube {

namespace {

dvec3 facet_normal(const TriangleMesh& mesh, const Triangle& t) {
  return glm::cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
}

double corner_angle(const TriangleMesh& mesh, const Triangle& t, int c) {
  const dvec3 &at = mesh.vertices[t[c]], a = mesh.vertices[t[(c + 1) % 3]] - at, b = mesh.vertices[t[(c + 2) % 3]] - at;
  return angle_between(a, b);
}

// Vertices at which facets of a surface leave out as much as the bluntest cone does: 2 pi (1 - sin(half angle)).
std::map<std::uint32_t, std::vector<TipFacet>> sharp_vertices(const CurvedTarget& target, double sine) {
  const TriangleMesh& mesh = target.tracer.mesh();
  std::vector<double> angles(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles)
    for (int c = 0; c < 3; ++c) angles[t[c]] += corner_angle(mesh, t, c);
  std::map<std::uint32_t, std::vector<TipFacet>> found;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    for (int c = 0; c < 3; ++c)
      if (const std::uint32_t v = mesh.triangles[i][c]; angles[v] < 2 * pi * sine) found[v].push_back({i, c});
  return found;
}

// Whether facets stand all round the axis: neighbours are 0.85 rad apart at most; those of a pyramid of eight sides are by 0.79.
bool all_round(std::vector<double> azimuths) {
  std::ranges::sort(azimuths);
  double widest = 2 * pi - azimuths.back() + azimuths.front();
  for (std::size_t i = 1; i < azimuths.size(); ++i) widest = std::max(widest, azimuths[i] - azimuths[i - 1]);
  return widest < 0.85;
}

bool is_smooth(const CurvedTarget& target, std::span<const TipFacet> facets) {
  return std::ranges::all_of(facets, [&](const TipFacet& f) {
    return target.surfaces.conducts(f.triangle) && target.tracer.mesh().closed(f.triangle) &&
           target.surfaces.region(f.triangle) == target.surfaces.region(facets.front().triangle);
  });
}

// A cone's facets all have the same slope to its axis, the sine of its half angle, within 0.1.
bool is_cone(const Tip& tip, std::span<const dvec3> normals) {
  const dvec3 across = glm::normalize(normals.front() - glm::dot(normals.front(), tip.outwards) * tip.outwards);
  const dvec3 other = glm::cross(tip.outwards, across);
  std::vector<double> azimuths;
  for (const dvec3& n : normals) {
    if (std::abs(glm::dot(n, tip.outwards) - std::sin(tip.half_angle)) > 0.1) return false;
    azimuths.push_back(std::atan2(glm::dot(n, other), glm::dot(n, across)));
  }
  return all_round(std::move(azimuths));
}

std::vector<dvec3> normals_of(const TriangleMesh& mesh, std::span<const TipFacet> facets) {
  std::vector<dvec3> normals;
  for (const TipFacet& f : facets) normals.push_back(glm::normalize(facet_normal(mesh, mesh.triangles[f.triangle])));
  return normals;
}

}  // namespace

std::vector<Tip> find_tips(const CurvedTarget& target) {
  constexpr double last = tip_table::first_angle + tip_table::angle_step * (tip_table::amplitudes.size() - 1.0);
  const TriangleMesh& mesh = target.tracer.mesh();
  std::vector<Tip> tips;
  for (auto& [vertex, facets] : sharp_vertices(target, std::sin(last * degree))) {
    if (!is_smooth(target, facets)) continue;
    const std::vector<dvec3> normals = normals_of(mesh, facets);
    dvec3 sum(0.0);
    double turn = 0.0;
    for (std::size_t i = 0; i < facets.size(); ++i) {
      const double angle = corner_angle(mesh, mesh.triangles[facets[i].triangle], facets[i].corner);
      sum += angle * normals[i], turn += angle;
    }
    const double sine = glm::length(sum) / turn;
    if (sine < std::sin(tip_table::first_angle * degree) || sine > std::sin(last * degree)) continue;
    Tip tip{{mesh.vertices[vertex], sum / (sine * turn), std::asin(sine)}, std::move(facets)};
    if (is_cone(tip, normals)) tips.push_back(std::move(tip));
  }
  return tips;
}

}  // namespace raytube
