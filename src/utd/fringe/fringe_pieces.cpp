#include "utd/fringe/fringe_pieces.h"

#include "utd/fringe/edge_pass.h"
#include "utd/shadow/lit_edges.h"

namespace raytube {

std::vector<LitInterval> cut_at_cells(const Wedge& wedge, std::span<const LitInterval> lit, const ImageLattice& lattice) {
  std::vector<LitInterval> parts;
  for (const auto& [begin, end] : lit) {
    const std::vector<double> shares = lattice.crossings(point_on(wedge, begin), point_on(wedge, end));
    for (std::size_t i = 1; i < shares.size(); ++i)
      parts.push_back({begin + shares[i - 1] * (end - begin), begin + shares[i] * (end - begin)});
  }
  return parts;
}

std::vector<ImageEdge> fringe_pieces(const EdgeScene& scene, const Look& look, std::span<const double> frequencies,
                                     const PieceRequest& request, const FringeOptions& options) {
  const LookVectors vectors = look_vectors(look);
  LitEdges light(scene.wedges, scene.tracer, vectors, shortest_wavelength(frequencies), options.receiver_shadow);
  return at_order(scene, options, [&](auto make) {
    EdgePieces pieces(scene.wedges, frequencies, request, [&](std::span<const double> list) { return make(vectors, list); });
    const auto edges = make(vectors, frequencies);
    for (std::uint32_t index = 0; index < scene.wedges.size(); ++index)
      if (const auto meeting = edges.meeting(index); meeting && light.find(index, meeting->incidence))
        pieces.add(index, light.lit());
    return pieces.take();
  });
}

}  // namespace raytube
