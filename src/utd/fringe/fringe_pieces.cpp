#include "utd/fringe/fringe_pieces.h"

#include "utd/fringe/corner_pass.h"

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

void add_wave_pieces(const EdgeScene& scene, std::uint32_t index, std::span<const LitInterval> lit, const LookVectors& look,
                     double frequency, const PieceRequest& request, std::vector<ImageEdge>& pieces) {
  const Wedge& wedge = scene.wedges[index];
  const auto of_share = [&](double share) {
    ScatteringMatrix s;
    scene.corners->add(index, share, look, std::span(&frequency, 1), std::span(&s, 1));
    return s;
  };
  if (request.by_path) {
    const dvec3 place = scene.corners->place(index, look.scattered);
    pieces.push_back({place, place, of_share(lit_share(lit))});
    return;
  }
  for (const LitInterval& part : cut_at_cells(wedge, lit, request.lattice))
    pieces.push_back({point_on(wedge, part.begin), point_on(wedge, part.end), of_share(part.end - part.begin)});
}

std::vector<ImageEdge> fringe_pieces(const EdgeScene& scene, const Look& look, std::span<const double> frequencies,
                                     const PieceRequest& request, const FringeOptions& options) {
  const LookVectors vectors = look_vectors(look);
  LitEdges light(scene.wedges, scene.tracer, vectors, shortest_wavelength(frequencies), options.receiver_shadow);
  std::vector<ImageEdge> found = at_order(scene, options, [&](auto make) {
    EdgePieces pieces(scene.wedges, frequencies, request, [&](std::span<const double> list) { return make(vectors, list); });
    const auto edges = make(vectors, frequencies);
    for (std::uint32_t index = 0; index < scene.wedges.size(); ++index)
      if (const auto meeting = edges.meeting(index); meeting && light.find(index, meeting->incidence))
        pieces.add(index, light.lit());
    return pieces.take();
  });
  const auto incident = [&](const Wedge&) { return vectors.incident; };
  for_edges_between_corners(scene, light, incident, [&](std::uint32_t index, std::span<const LitInterval> lit) {
    add_wave_pieces(scene, index, lit, vectors, frequencies[request.frequency_index], request, found);
  });
  return found;
}

}  // namespace raytube
