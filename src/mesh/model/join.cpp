#include "mesh/model/join.h"

#include <algorithm>

#include "mesh/model/geometry.h"

namespace raytube {

namespace {

Box common_box(std::span<const TriangleMesh> parts) {
  Box box;
  for (const TriangleMesh& part : parts)
    for (const dvec3& v : part.vertices) box.add(v + part.center);
  return box;
}

void append(const TriangleMesh& part, const dvec3& shift, TriangleMesh& whole) {
  const auto first_vertex = static_cast<std::uint32_t>(whole.vertices.size());
  const auto first_patch = static_cast<std::uint32_t>(whole.patches.size());
  const auto first_component = static_cast<std::uint32_t>(whole.components.size());
  for (const dvec3& v : part.vertices) whole.vertices.push_back(v + shift);
  for (const auto& [a, b, c] : part.triangles) whole.triangles.push_back({a + first_vertex, b + first_vertex, c + first_vertex});
  for (const std::uint32_t patch : part.triangle_patch) whole.triangle_patch.push_back(patch + first_patch);
  for (const std::uint32_t component : part.triangle_component) whole.triangle_component.push_back(component + first_component);
  for (const Patch& p : part.patches) whole.patches.push_back({p.normal, p.offset + glm::dot(p.normal, shift), p.material});
  whole.components.insert(whole.components.end(), part.components.begin(), part.components.end());
}

}  // namespace

JoinedMesh join_meshes(std::span<const TriangleMesh> parts) {
  JoinedMesh joined;
  TriangleMesh& mesh = joined.mesh;
  mesh.center = common_box(parts).middle();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    append(parts[i], parts[i].center - mesh.center, mesh);
    joined.triangle_part.resize(mesh.triangles.size(), static_cast<std::uint32_t>(i));
  }
  for (const TriangleMesh& part : parts) mesh.coordinate_step = std::max(mesh.coordinate_step, part.coordinate_step);
  for (const dvec3& v : mesh.vertices) mesh.radius = std::max(mesh.radius, glm::length(v));
  return joined;
}

}  // namespace raytube
