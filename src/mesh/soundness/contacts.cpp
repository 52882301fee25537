#include "mesh/soundness/contacts.h"

#include <algorithm>

namespace raytube {

namespace {

using Corners = std::array<dvec3, 3>;

// Of triangles with a corner in common so much is looked at.
constexpr double inner_part = 0.98;

Corners corners_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

Corners inner(Corners corners) {
  const dvec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  for (dvec3& corner : corners) corner = middle + inner_part * (corner - middle);
  return corners;
}

// Whether a gap wider than that is between them along the axis; none if it has no length.
bool apart_along(const dvec3& axis, const Corners& a, const Corners& b, double margin) {
  const auto along = [&](const dvec3& corner) { return glm::dot(axis, corner); };
  const auto [low_a, high_a] = std::minmax({along(a[0]), along(a[1]), along(a[2])});
  const auto [low_b, high_b] = std::minmax({along(b[0]), along(b[1]), along(b[2])});
  return std::max(low_b - high_a, low_a - high_b) > margin * glm::length(axis);
}

// Separating axes of two triangles: normals, normals of sides in their planes, and what is across two sides (Gottschalk, Lin &
// Manocha 1996, SIGGRAPH, section 5).
bool are_apart(const Corners& a, const Corners& b, double margin) {
  const dvec3 normal_a = area_vector(a[0], a[1], a[2]), normal_b = area_vector(b[0], b[1], b[2]);
  if (apart_along(normal_a, a, b, margin) || apart_along(normal_b, a, b, margin)) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec3 side_a = a[(i + 1) % 3] - a[i], side_b = b[(i + 1) % 3] - b[i];
    if (apart_along(glm::cross(normal_a, side_a), a, b, margin) || apart_along(glm::cross(normal_b, side_b), a, b, margin))
      return true;
    for (std::size_t k = 0; k < 3; ++k)
      if (apart_along(glm::cross(side_a, b[(k + 1) % 3] - b[k]), a, b, margin)) return true;
  }
  return false;
}

bool have_a_corner_in_common(const Triangle& a, const Triangle& b) {
  return std::ranges::any_of(a, [&](std::uint32_t corner) { return std::ranges::find(b, corner) != b.end(); });
}

bool touch(const TriangleMesh& mesh, std::uint32_t t, std::uint32_t other, double margin) {
  const Corners a = corners_of(mesh, t), b = corners_of(mesh, other);
  if (!have_a_corner_in_common(mesh.triangles[t], mesh.triangles[other])) return !are_apart(a, b, margin);
  return !are_apart(inner(a), inner(b), margin);
}

// Fills `found` with faces whose boxes reach into that of a triangle, widened by `margin`.
void collect_near(const FaceTree& faces, const Corners& corners, double margin, std::vector<std::uint32_t>& found) {
  const Box box = bounding_box(corners);
  const dvec3 low = box.low - margin, high = box.high + margin;
  const Patch bottom{dvec3(0, 0, 1), low.z};
  const Prism prism{dvec3(0.0), dvec3(1, 0, 0), dvec3(0, 1, 0), bottom.normal, dvec2(low), dvec2(high), high.z, &bottom, 1.0};
  faces.collect(prism, found);
}

}  // namespace

std::optional<Contact> find_contact(const FaceTree& faces, const std::function<bool(std::uint32_t)>& wanted) {
  const TriangleMesh& mesh = faces.mesh();
  const double margin = flat_fraction * 2.0 * mesh.radius;
  std::vector<std::uint32_t> found;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    collect_near(faces, corners_of(mesh, t), margin, found);
    for (const std::uint32_t face : found)
      for (const std::uint32_t other : faces.triangles(face)) {
        const std::uint32_t component = mesh.triangle_component[other];
        if (component != mesh.triangle_component[t] && wanted(component) && touch(mesh, t, other, margin))
          return Contact{t, other};
      }
  }
  return {};
}

}  // namespace raytube
