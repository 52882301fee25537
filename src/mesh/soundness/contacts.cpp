#include "mesh/soundness/contacts.h"

#include "mesh/model/triangle_pairs.h"

namespace raytube {

namespace {

// Of triangles with a corner in common so much is looked at.
constexpr double inner_part = 0.98;

Corners inner(Corners corners) {
  const dvec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  for (dvec3& corner : corners) corner = middle + inner_part * (corner - middle);
  return corners;
}

bool touch(const TriangleMesh& mesh, std::uint32_t t, std::uint32_t other, double margin) {
  const Corners a = mesh.corners(t), b = mesh.corners(other);
  if (!share_corner(mesh.triangles[t], mesh.triangles[other])) return !are_apart(a, b, margin);
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
    collect_near(faces, mesh.corners(t), margin, found);
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
