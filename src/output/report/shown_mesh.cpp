#include "output/report/shown_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace raytube {

namespace {

using Triangle = std::array<std::uint32_t, 3>;
constexpr std::uint32_t none = 0xffffffffu;

double area(std::span<const dvec3> vertices, std::span<const Triangle> triangles) {
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles)
    sum += 0.5 * glm::length(glm::cross(vertices[b] - vertices[a], vertices[c] - vertices[a]));
  return sum;
}

// The cluster of each vertex, numbered as they come up, and their middles.
struct Clusters {
  std::vector<std::uint32_t> of;
  std::vector<dvec3> middles;
};

Clusters clusters_of(std::span<const dvec3> vertices, double cell) {
  Clusters clusters;
  std::map<std::array<std::int64_t, 3>, std::uint32_t> numbers;
  std::vector<double> counts;
  for (const dvec3& vertex : vertices) {
    const dvec3 at = glm::floor(vertex / cell);
    const auto [place, is_new] =
        numbers.try_emplace({std::int64_t(at.x), std::int64_t(at.y), std::int64_t(at.z)}, std::uint32_t(numbers.size()));
    if (is_new) clusters.middles.emplace_back(0.0), counts.push_back(0.0);
    clusters.middles[place->second] += vertex;
    counts[place->second] += 1.0;
    clusters.of.push_back(place->second);
  }
  for (std::size_t i = 0; i < counts.size(); ++i) clusters.middles[i] /= counts[i];
  return clusters;
}

// Triangles that became one, or a line: the first stands for all, for a line the first that has its corner.
ShownMesh clustered(std::span<const dvec3> vertices, std::span<const Triangle> triangles, double cell) {
  Clusters clusters = clusters_of(vertices, cell);
  ShownMesh mesh{std::move(clusters.middles), {}, {}};
  std::map<Triangle, std::uint32_t> numbers;
  std::vector<std::uint32_t> at_corner(mesh.vertices.size(), none);
  for (const auto& [a, b, c] : triangles) {
    const Triangle moved{clusters.of[a], clusters.of[b], clusters.of[c]};
    Triangle corners = moved;
    std::ranges::sort(corners);
    mesh.shown_as.push_back(none);
    if (corners[0] == corners[1] || corners[1] == corners[2]) continue;
    const auto [place, is_new] = numbers.try_emplace(corners, std::uint32_t(mesh.triangles.size()));
    if (is_new) mesh.triangles.push_back(moved);
    mesh.shown_as.back() = place->second;
    for (const std::uint32_t corner : corners)
      if (at_corner[corner] == none) at_corner[corner] = place->second;
  }
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (const std::uint32_t corner : triangles[i])
      if (mesh.shown_as[i] == none) mesh.shown_as[i] = at_corner[clusters.of[corner]];
  for (std::uint32_t& shown : mesh.shown_as)
    if (shown == none) shown = 0;  // a body smaller than a cell
  return mesh;
}

}  // namespace

ShownMesh shown_mesh(std::span<const dvec3> vertices, std::span<const Triangle> triangles, std::size_t most) {
  if (triangles.size() <= most) {
    ShownMesh mesh{{vertices.begin(), vertices.end()}, {triangles.begin(), triangles.end()}, {}};
    mesh.shown_as.resize(triangles.size());
    std::iota(mesh.shown_as.begin(), mesh.shown_as.end(), 0u);
    return mesh;
  }
  constexpr double finer = 0.25, coarser = 1.15;
  double cell = finer * std::sqrt(area(vertices, triangles) / static_cast<double>(most));
  ShownMesh mesh = clustered(vertices, triangles, cell);
  while (mesh.triangles.size() > most) mesh = clustered(vertices, triangles, cell *= coarser);
  return mesh;
}

}  // namespace raytube
