#include "mesh/features/overlaps.h"

#include "mesh/model/geometry.h"
#include "mesh/model/triangle_pairs.h"

namespace raytube {

namespace {

// Where two closed bodies touch no wave gets between them.
bool have_a_side_in_common(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
  return !mesh.closed(a) || !mesh.closed(b) || glm::dot(mesh.patch_of(a).normal, mesh.patch_of(b).normal) > 0.0;
}

}  // namespace

Overlaps overlaps_of_materials(const Tracer& tracer) {
  const TriangleMesh& mesh = tracer.mesh();
  const double in_one_plane = flat_fraction * bounding_box(mesh.vertices).diagonal();
  Overlaps overlaps;
  for (std::uint32_t a = 0; a < mesh.triangles.size(); ++a)
    for (const std::uint32_t b : tracer.near_coincident(a)) {
      if (b < a || mesh.patch_of(a).material == mesh.patch_of(b).material || !have_a_side_in_common(mesh, a, b)) continue;
      if (!lie_upon_one_another(mesh.corners(a), mesh.corners(b), in_one_plane)) continue;
      if (overlaps.pairs++ == 0) overlaps.example = {a, b};
    }
  return overlaps;
}

}  // namespace raytube
