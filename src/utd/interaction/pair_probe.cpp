#include "utd/interaction/pair_probe.h"

#include <algorithm>
#include <vector>

#include "utd/interaction/edge_axes.h"

namespace raytube {

namespace {

constexpr std::size_t trials = 2, ranks = 16;  // pairs tried, among so many of the longest edges and the largest faces

std::vector<const EdgeAxis*> longest_axes(std::span<const EdgeAxis> axes) {
  std::vector<const EdgeAxis*> longest;
  for (const EdgeAxis& axis : axes) longest.push_back(&axis);
  const auto count = static_cast<std::ptrdiff_t>(std::min(ranks, longest.size()));
  std::ranges::partial_sort(longest, longest.begin() + count, [](const EdgeAxis* a, const EdgeAxis* b) {
    return a->length > b->length || (a->length == b->length && a < b);
  });
  longest.resize(static_cast<std::size_t>(count));
  return longest;
}

}  // namespace

PairWork try_pairs(const PairProbe& probe, double most) {
  const TriangleMesh& mesh = probe.faces.tree.mesh();
  const std::vector<const EdgeAxis*> axes = longest_axes(probe.axes);
  PairWork sum;
  std::size_t tried = 0;
  for (std::size_t i = 0; i < std::min(axes.size(), probe.faces.by_area.size()) && tried < trials; ++i) {
    const EdgeAxis& axis = *axes[i];
    const std::uint32_t patch = probe.faces.by_area[i];
    const WedgeIncidence incidence = incidence_on(*axis.wedge, probe.incident.direction);
    const LitEdgePiece piece{&axis, &probe.incident, incidence.faces[0],
                             0.0,   axis.length,     incidence_weight(*axis.wedge, incidence)};
    const PairView view{std::ranges::max(probe.wavenumbers), probe.look.scattered};
    if (piece.weight == 0.0 || patch == axis.wedge->faces[0].patch || patch == axis.wedge->faces[1].patch) continue;
    const PairBound bound = pair_bound(piece, mesh.patches[patch], probe.extents[patch], view, probe.reflections);
    if (bound.amplitude == 0.0) continue;
    const ReceivingFaces only{probe.faces.tree,     probe.faces.large, probe.faces.corners, std::span(&patch, 1), {},
                              probe.faces.materials};
    sum.trials += illuminated_faces(only, probe.look, probe.wavenumbers, piece,
                                    {probe.reflections, probe.tolerance, std::span(&bound.azimuths, 1), most})
                      .work;
    ++tried;
  }
  if (tried > 0) sum.each = sum.trials / static_cast<double>(tried);
  return sum;
}

}  // namespace raytube
