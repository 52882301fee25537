// Small targets for the edge tests, built by hand so that they do not depend on the mesh readers. Wavelength 1 m throughout.
#pragma once

#include <algorithm>
#include <vector>

#include "mesh/features/wedges.h"
#include "mesh/trace/tracer.h"

namespace raytube::test {

inline constexpr double frequency_1m = speed_of_light;  // [Hz] wavelength 1 m, k = 2 pi / m

struct Scene {
  TriangleMesh mesh;
  std::vector<Wedge> wedges;
};

/// Adds the parallelogram center +- a +- b as one patch of its own component; the normal is along a x b.
inline std::uint32_t add_panel(TriangleMesh& mesh, const dvec3& center, const dvec3& a, const dvec3& b) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto patch = static_cast<std::uint32_t>(mesh.patches.size());
  for (const dvec3& corner : {center - a - b, center + a - b, center + a + b, center - a + b}) {
    mesh.vertices.push_back(corner);
    mesh.radius = std::max(mesh.radius, glm::length(corner));
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
  mesh.triangle_patch.insert(mesh.triangle_patch.end(), 2, patch);
  mesh.triangle_component.insert(mesh.triangle_component.end(), 2, patch);
  const dvec3 normal = glm::normalize(glm::cross(a, b));
  mesh.patches.push_back({normal, glm::dot(normal, center)});
  mesh.components.push_back({false, 2});
  return patch;
}

inline Wedge half_plane(const dvec3& start, const dvec3& end, const dvec3& into_face, const dvec3& normal, double width,
                        std::uint32_t patch) {
  return {start, end, 2.0, {WedgeFace{patch, into_face, normal, width}, WedgeFace{patch, into_face, -normal, width}}};
}

/// Plate of the given sides in the plane z = 0, centred, with its four edges.
inline Scene plate(double side_x, double side_y) {
  const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), a = x * (side_x / 2), b = y * (side_y / 2);
  Scene scene;
  const std::uint32_t patch = add_panel(scene.mesh, dvec3(0.0), a, b);
  scene.wedges = {half_plane(a - b, a + b, -x, z, side_x, patch), half_plane(-a - b, b - a, x, z, side_x, patch),
                  half_plane(b - a, a + b, -y, z, side_y, patch), half_plane(-a - b, a - b, y, z, side_y, patch)};
  return scene;
}

/// The wedge of a box between the faces with outward normals a and b (axis vectors).
inline Wedge box_wedge(double side, const dvec3& a, const dvec3& b, std::uint32_t patch_a, std::uint32_t patch_b) {
  const dvec3 middle = (a + b) * (side / 2), along = glm::cross(a, b) * (side / 2);
  return {middle - along, middle + along, 1.5, {WedgeFace{patch_a, -b, a, side}, WedgeFace{patch_b, -a, b, side}}};
}

/// Cube centred at the origin, faces across the axes, with its twelve wedges.
inline Scene cube(double side) {
  Scene scene;
  std::vector<dvec3> normals;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      dvec3 normal(0.0), a(0.0), b(0.0);
      normal[axis] = sign;
      a[(axis + 1) % 3] = sign * side / 2;
      b[(axis + 2) % 3] = side / 2;
      normals.push_back(normal);
      add_panel(scene.mesh, normal * (side / 2), a, b);
    }
  for (std::uint32_t i = 0; i < 6; ++i)
    for (std::uint32_t j = i + 1; j < 6; ++j)
      if (glm::dot(normals[i], normals[j]) == 0.0) scene.wedges.push_back(box_wedge(side, normals[i], normals[j], i, j));
  return scene;
}

}  // namespace raytube::test
