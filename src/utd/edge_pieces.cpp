// What the edges of a look add, piece by piece.
#include "utd/edge_pass.h"
#include "utd/lit_edges.h"

namespace raytube {

namespace {

dvec3 at(const Wedge& wedge, double share) { return wedge.start + share * (wedge.end - wedge.start); }

/// The parts of the lit ones within a cell each.
std::vector<LitInterval> cut_up(const Wedge& wedge, std::span<const LitInterval> lit, const ImageLattice& lattice) {
  std::vector<LitInterval> parts;
  for (const auto& [begin, end] : lit) {
    const std::vector<double> shares = lattice.crossings(at(wedge, begin), at(wedge, end));
    for (std::size_t i = 1; i < shares.size(); ++i)
      parts.push_back({begin + shares[i - 1] * (end - begin), begin + shares[i] * (end - begin)});
  }
  return parts;
}

/// What one edge adds, in pieces. Quadrature along the pieces differs from that along the whole by its error, which they share.
template <class MakeEdges>
class Pieces {
 public:
  Pieces(std::span<const Wedge> wedges, const ImageLattice& lattice, std::span<const double> frequencies, std::size_t frequency,
         MakeEdges make)
      : wedges_(wedges), lattice_(lattice), frequencies_(frequencies), frequency_(frequency), make_(make) {}

  void add(std::uint32_t index, std::span<const LitInterval> lit) {
    const Wedge& wedge = wedges_[index];
    ScatteringMatrix rest = of(index, lit, frequencies_, frequency_);
    const std::vector<LitInterval> parts = cut_up(wedge, lit, lattice_);
    const std::size_t first = pieces_.size();
    double length = 0.0;
    for (const LitInterval& part : parts) {
      const ScatteringMatrix s =
          parts.size() == 1 ? rest : of(index, std::span(&part, 1), frequencies_.subspan(frequency_, 1), 0);
      pieces_.push_back({at(wedge, part.begin), at(wedge, part.end), s});
      rest = rest - s;
      length += part.end - part.begin;
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      ScatteringMatrix share = rest;
      pieces_[first + i].s += share *= (parts[i].end - parts[i].begin) / length;
    }
  }

  std::vector<ImageEdge> take() { return std::move(pieces_); }

 private:
  ScatteringMatrix of(std::uint32_t index, std::span<const LitInterval> lit, std::span<const double> frequencies,
                      std::size_t frequency) const {
    auto edges = make_(frequencies);
    edges.add(index, *edges.meeting(index), lit);
    const EdgeLookResult result = edges.take();
    ScatteringMatrix sum = result.scattering[frequency];
    if (!result.higher.empty()) sum += result.higher[frequency];
    return sum;
  }

  std::span<const Wedge> wedges_;
  const ImageLattice& lattice_;
  std::span<const double> frequencies_;
  std::size_t frequency_;
  MakeEdges make_;
  std::vector<ImageEdge> pieces_;
};

template <class MakeEdges>
std::vector<ImageEdge> pieces_of(std::span<const Wedge> wedges, LitEdges& light, const ImageLattice& lattice,
                                 std::span<const double> frequencies, std::size_t frequency, MakeEdges make) {
  Pieces<MakeEdges> pieces(wedges, lattice, frequencies, frequency, make);
  const auto edges = make(frequencies);
  for (std::uint32_t index = 0; index < wedges.size(); ++index)
    if (const auto meeting = edges.meeting(index); meeting && light.find(index, meeting->incidence))
      pieces.add(index, light.lit());
  return pieces.take();
}

}  // namespace

std::vector<ImageEdge> fringe_pieces(std::span<const Wedge> wedges, const Outlines& outlines, const Tracer& tracer,
                                     const Look& look, std::span<const double> frequencies, std::size_t frequency, int order,
                                     bool receiver_shadow, TransitionTier tier, bool mirror_at_folds,
                                     const ImageLattice& lattice) {
  const LookVectors vectors = look_vectors(look);
  LitEdges light(wedges, tracer, vectors, shortest_wavelength(frequencies), receiver_shadow);
  if (order == 1)
    return pieces_of(wedges, light, lattice, frequencies, frequency,
                     [&](std::span<const double> list) { return EndlessEdges(wedges, vectors, list); });
  return pieces_of(wedges, light, lattice, frequencies, frequency, [&](std::span<const double> list) {
    return StripPass(wedges, outlines, vectors, list, order, tier, mirror_at_folds);
  });
}

}  // namespace raytube
