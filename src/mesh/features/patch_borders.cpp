#include "mesh/features/patch_borders.h"

#include <algorithm>
#include <numeric>

namespace raytube {

namespace {

/// Calls visit(patch, edge) for the edges round each patch.
template <class Visit>
void for_each_border_edge(const TriangleMesh& mesh, Visit visit) {
  const EdgeTable& edges = mesh.edges();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const EdgeTable::Edge edge = edges[e];
    if (mesh.is_inside_patch(edge)) continue;
    for (const EdgeTable::Side& side : edge.sides) visit(mesh.triangle_patch[side.triangle], edge);
  }
}

}  // namespace

PatchBorders::PatchBorders(const TriangleMesh& mesh) : first_(mesh.patches.size() + 1, 0) {
  for_each_border_edge(mesh, [&](std::uint32_t patch, const EdgeTable::Edge&) { first_[patch + 1] += 2; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  vertices_.resize(first_.back());
  last_.assign(first_.begin(), first_.end() - 1);
  for_each_border_edge(mesh, [&](std::uint32_t patch, const EdgeTable::Edge& edge) {
    vertices_[last_[patch]++] = edge.low;
    vertices_[last_[patch]++] = edge.high;
  });
  for (std::uint32_t patch = 0; patch < last_.size(); ++patch) {
    const auto begin = vertices_.begin() + first_[patch], end = vertices_.begin() + last_[patch];
    std::sort(begin, end);
    last_[patch] = first_[patch] + static_cast<std::uint32_t>(std::unique(begin, end) - begin);
  }
}

}  // namespace raytube
