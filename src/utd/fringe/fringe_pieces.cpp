#include "utd/fringe/fringe_pieces.h"

#include "utd/shadow/lit_edges.h"

namespace raytube {

namespace {

template <class MakeEdges>
std::vector<ImageEdge> pieces_of(std::span<const Wedge> wedges, LitEdges& light, const ImageLattice& lattice,
                                 std::span<const double> frequencies, std::size_t frequency, MakeEdges make) {
  EdgePieces<MakeEdges> pieces(wedges, lattice, frequencies, frequency, make);
  const auto edges = make(frequencies);
  for (std::uint32_t index = 0; index < wedges.size(); ++index)
    if (const auto meeting = edges.meeting(index); meeting && light.find(index, meeting->incidence))
      pieces.add(index, light.lit());
  return pieces.take();
}

}  // namespace

std::vector<ImageEdge> fringe_pieces(std::span<const Wedge> wedges, const Outlines& outlines, const Tracer& tracer,
                                     const Look& look, std::span<const double> frequencies, std::size_t frequency, int order,
                                     bool receiver_shadow, TransitionTier tier, bool continue_by_images,
                                     const ImageLattice& lattice) {
  const LookVectors vectors = look_vectors(look);
  LitEdges light(wedges, tracer, vectors, shortest_wavelength(frequencies), receiver_shadow);
  if (order == 1)
    return pieces_of(wedges, light, lattice, frequencies, frequency,
                     [&](std::span<const double> list) { return FirstOrderEdges(wedges, vectors, list); });
  return pieces_of(wedges, light, lattice, frequencies, frequency, [&](std::span<const double> list) {
    return StripPass(wedges, outlines, vectors, list, order, tier, continue_by_images);
  });
}

}  // namespace raytube
