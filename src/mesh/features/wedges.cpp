#include "mesh/features/wedges.h"

#include <algorithm>

#include "mesh/features/edge_sectors.h"
#include "mesh/features/patch_borders.h"

namespace raytube {

namespace {

double extent(const TriangleMesh& mesh, std::span<const std::uint32_t> vertices, const dvec3& from, const dvec3& direction) {
  double extent = 0.0;
  for (const std::uint32_t v : vertices) extent = std::max(extent, glm::dot(mesh.vertices[v] - from, direction));
  return extent;
}

/// A face is no narrower than the `distance` by which its plane is known.
Wedge wedge_of(const TriangleMesh& mesh, const PatchBorders& borders, const EdgeSector& run, double distance) {
  Wedge wedge{mesh.vertices[run.start], mesh.vertices[run.end], run.n, {}};
  const dvec3 tangent = glm::normalize(wedge.end - wedge.start);
  std::array<FaceFrame, 2> frames;
  for (int i = 0; i < 2; ++i) {
    const std::uint32_t patch = run.faces[i].patch;
    frames[i] = face_frame(mesh, run.faces[i], tangent, i);
    wedge.faces[i] = {patch,
                      frames[i].into_face,
                      frames[i].normal,
                      std::max(distance, extent(mesh, borders[patch], wedge.start, frames[i].into_face)),
                      run.faces[i].back,
                      mesh.patches[patch].material};
  }
  wedge.n = refined_n(frames[0], frames[1], run.n);
  return wedge;
}

}  // namespace

std::vector<Wedge> find_wedges(const TriangleMesh& mesh, double min_wedge_angle) {
  std::vector<EdgeSector> sectors =
      exposed_sectors(mesh, [&](const EdgeSector& sector) { return is_wedge(mesh, sector, min_wedge_angle); });
  const double distance = flat_fraction * bounding_box(mesh.vertices).diagonal();
  const PatchBorders borders(mesh);
  std::vector<Wedge> wedges;
  for (const EdgeSector& run : join_straight(mesh.vertices, std::move(sectors), distance))
    wedges.push_back(wedge_of(mesh, borders, run, distance));
  return wedges;
}

}  // namespace raytube
