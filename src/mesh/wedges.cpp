#include "mesh/wedges.h"

#include <algorithm>

#include "mesh/edge_pieces.h"

namespace raytube {

namespace {

/// The vertices on the rim of each patch; the patch's extent in any direction is theirs.
class PatchRims {
 public:
  PatchRims(const TriangleMesh& mesh, const EdgeTable& edges) : mesh_(mesh), rim_(mesh.patches.size()) {
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto [low, high, sides] = edges[e];
      const auto patch = [&](const EdgeTable::Side& side) { return mesh.triangle_patch[side.triangle]; };
      if (sides.size() == 2 && patch(sides[0]) == patch(sides[1])) continue;
      for (const EdgeTable::Side& side : sides) rim_[patch(side)].insert(rim_[patch(side)].end(), {low, high});
    }
    for (auto& vertices : rim_) {
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    }
  }

  double extent(std::uint32_t patch, const dvec3& from, const dvec3& direction) const {
    double extent = 0.0;
    for (const std::uint32_t v : rim_[patch]) extent = std::max(extent, glm::dot(mesh_.vertices[v] - from, direction));
    return extent;
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<std::vector<std::uint32_t>> rim_;
};

/// A face is no narrower than the `distance` by which its plane is known.
Wedge wedge_of(const TriangleMesh& mesh, const PatchRims& rims, const EdgePiece& run, double distance) {
  Wedge wedge{mesh.vertices[run.start], mesh.vertices[run.end], run.n, {}};
  const dvec3 tangent = glm::normalize(wedge.end - wedge.start);
  std::array<FaceFrame, 2> frames;
  for (int i = 0; i < 2; ++i) {
    const std::uint32_t patch = run.faces[i].patch;
    frames[i] = face_frame(mesh, run.faces[i], tangent, i);
    wedge.faces[i] = {patch, frames[i].into_face, frames[i].normal,
                      std::max(distance, rims.extent(patch, wedge.start, frames[i].into_face)), run.faces[i].back};
  }
  wedge.n = refined_n(frames[0], frames[1], run.n);
  return wedge;
}

}  // namespace

std::vector<Wedge> find_wedges(const TriangleMesh& mesh, double min_wedge_angle) {
  const EdgeTable edges(mesh.triangles, mesh.vertices.size());
  std::vector<EdgePiece> pieces = exposed_sectors(mesh, edges);
  std::erase_if(pieces, [&](const EdgePiece& piece) { return !is_wedge(piece, min_wedge_angle); });
  const double distance = flat_fraction * bounding_box(mesh.vertices).diagonal();
  const PatchRims rims(mesh, edges);
  std::vector<Wedge> wedges;
  for (const EdgePiece& run : join_straight(mesh.vertices, std::move(pieces), distance))
    wedges.push_back(wedge_of(mesh, rims, run, distance));
  return wedges;
}

}  // namespace raytube
