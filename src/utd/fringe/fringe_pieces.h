// What single edges add to a look, in pieces within a cell of a lattice each.
#pragma once

#include "utd/fringe/edge_pass.h"

namespace raytube {

inline dvec3 place_on(const Wedge& wedge, double share) { return wedge.start + share * (wedge.end - wedge.start); }

/// The parts of the lit ones within a cell each.
inline std::vector<LitInterval> cut_up(const Wedge& wedge, std::span<const LitInterval> lit, const ImageLattice& lattice) {
  std::vector<LitInterval> parts;
  for (const auto& [begin, end] : lit) {
    const std::vector<double> shares = lattice.crossings(place_on(wedge, begin), place_on(wedge, end));
    for (std::size_t i = 1; i < shares.size(); ++i)
      parts.push_back({begin + shares[i - 1] * (end - begin), begin + shares[i] * (end - begin)});
  }
  return parts;
}

/// What one edge adds, in pieces. Quadrature along the pieces differs from that along the whole by its error, which they share.
template <class MakeEdges>
class EdgePieces {
 public:
  EdgePieces(std::span<const Wedge> wedges, const ImageLattice& lattice, std::span<const double> frequencies,
             std::size_t frequency, MakeEdges make)
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
      pieces_.push_back({place_on(wedge, part.begin), place_on(wedge, part.end), s});
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

}  // namespace raytube
