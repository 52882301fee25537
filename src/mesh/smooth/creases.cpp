#include "mesh/smooth/creases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace raytube {

namespace {

// Flatter creases are the rounding of coordinates.
constexpr double least_crease = 1e-6;

const dvec3& patch_normal(const TriangleMesh& mesh, std::uint32_t triangle) {
  return mesh.patches[mesh.triangle_patch[triangle]].normal;
}

bool is_one_plane(const Patch& a, const Patch& b) { return a.normal == b.normal && a.offset == b.offset; }

// For each patch a number in common with those that it would be one patch with if all were made of the same.
std::vector<std::uint32_t> uncut_patches(const TriangleMesh& mesh, const EdgeTable& edges) {
  std::vector<std::uint32_t> parents(mesh.patches.size());
  std::iota(parents.begin(), parents.end(), 0u);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].sides.size() != 2) continue;
    const std::uint32_t a = mesh.triangle_patch[edges[e].sides[0].triangle], b = mesh.triangle_patch[edges[e].sides[1].triangle];
    if (mesh.patches[a].material == mesh.patches[b].material || !is_one_plane(mesh.patches[a], mesh.patches[b])) continue;
    parents[find_root(parents, b)] = find_root(parents, a);
  }
  return number_sets(std::move(parents));
}

}  // namespace

Creases::Creases(const TriangleMesh& mesh, double max_turn)
    : mesh_(mesh), edges_(mesh.triangles, mesh.vertices.size()), borders_(mesh, edges_), plane_(uncut_patches(mesh, edges_)) {
  const std::uint32_t planes = plane_.empty() ? 0 : *std::ranges::max_element(plane_) + 1;
  patches_ = triangle_rows(planes, plane_, [](std::uint32_t plane) { return std::array{plane}; });
  crossable_.resize(edges_.size());
  for (std::size_t e = 0; e < edges_.size(); ++e) crossable_[e] = is_smooth(edges_[e], std::cos(max_turn));
}

bool Creases::is_smooth(const EdgeTable::Edge& edge, double least_cosine) const {
  if (edge.sides.size() != 2) return false;
  const auto [a, b] = std::pair(edge.sides[0], edge.sides[1]);
  const bool opposite = mesh_.triangles[a.triangle][a.corner] != mesh_.triangles[b.triangle][b.corner];
  return opposite && glm::dot(patch_normal(mesh_, a.triangle), patch_normal(mesh_, b.triangle)) > least_cosine;
}

bool Creases::is_crease(const EdgeTable::Edge& edge) const {
  const EdgeTable::Side &a = edge.sides[0], &b = edge.sides[1];
  return glm::length(patch_normal(mesh_, a.triangle) - patch_normal(mesh_, b.triangle)) > least_crease;
}

double Creases::width(const EdgeTable::Edge& edge, const EdgeTable::Side& side) const {
  const double length = glm::length(mesh_.vertices[edge.high] - mesh_.vertices[edge.low]);
  return glm::length(area_vector(mesh_.vertices, mesh_.triangles[side.triangle])) / length;
}

bool Creases::reaches(std::uint32_t plane, const EdgeTable::Edge& edge, double width) const {
  const dvec3 start = mesh_.vertices[edge.low], along = glm::normalize(mesh_.vertices[edge.high] - start);
  const auto is_far = [&](std::uint32_t v) { return glm::length(glm::cross(mesh_.vertices[v] - start, along)) > width; };
  return std::ranges::any_of(patches_[plane], [&](std::uint32_t patch) { return std::ranges::any_of(borders_[patch], is_far); });
}

}  // namespace raytube
