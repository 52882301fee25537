// What single edges add to a look, in pieces within a cell of a lattice each: for images.
#pragma once

#include <algorithm>
#include <iterator>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "scene/image.h"
#include "scene/sweep.h"
#include "utd/fringe/edge_pass.h"
#include "utd/shadow/edge_visibility.h"

namespace raytube {

/// What an image asks of edges. The lattice is kept by reference.
struct PieceRequest {
  std::size_t frequency_index;  // among the frequencies of the look, which choose the points along the edges together
  const ImageLattice& lattice;
  bool by_path = false;  // begin = end = where the wave's path has its place, of one frequency; else where the edge is lit
};

/// The currents of fringe_scattering() at one of the frequencies, piece by piece of the lit edges within a cell of the lattice
/// each: S [m] of those on the faces beside a piece, and of what these start at other edges. The pieces add up to the sum of all.
std::vector<ImageEdge> fringe_pieces(const EdgeScene& scene, const Look& look, std::span<const double> frequencies,
                                     const PieceRequest& request, const FringeOptions& options);

/// Waves from corner to corner of edge `index`, spread over its lit parts by length, unless asked for by path; appended to
/// `pieces`.
void add_wave_pieces(const EdgeScene& scene, std::uint32_t index, std::span<const LitInterval> lit, const LookVectors& look,
                     double frequency, const PieceRequest& request, std::vector<ImageEdge>& pieces);

/// The lit parts of an edge, cut where it goes from one cell into another.
std::vector<LitInterval> cut_at_cells(const Wedge& wedge, std::span<const LitInterval> lit, const ImageLattice& lattice);

/// Collects what edges add, in pieces; make(frequencies) is a new sum over edges (edge_pass.h). Quadrature along the pieces
/// differs from that along the whole edge by its error, which they share by length.
template <class MakeEdges>
class EdgePieces {
 public:
  EdgePieces(std::span<const Wedge> wedges, std::span<const double> frequencies, const PieceRequest& request, MakeEdges make)
      : wedges_(wedges), frequencies_(frequencies), request_(request), make_(make) {}

  void add(std::uint32_t index, std::span<const LitInterval> lit) {
    if constexpr (std::is_same_v<std::invoke_result_t<MakeEdges, std::span<const double>>, StripEdges>)
      if (request_.by_path) return add_by_path(index, lit);
    const Wedge& wedge = wedges_[index];
    ScatteringMatrix rest = scattering_of(index, lit, frequencies_, request_.frequency_index);
    const std::vector<LitInterval> parts = cut_at_cells(wedge, lit, request_.lattice);
    const std::size_t first = pieces_.size();
    double length = 0.0;
    for (const LitInterval& part : parts) {
      const ScatteringMatrix s =
          parts.size() == 1 ? rest
                            : scattering_of(index, std::span(&part, 1), frequencies_.subspan(request_.frequency_index, 1), 0);
      pieces_.push_back({point_on(wedge, part.begin), point_on(wedge, part.end), s});
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
  void add_by_path(std::uint32_t index, std::span<const LitInterval> lit) {
    auto edges = make_(frequencies_);
    const std::vector<LitInterval> parts = cut_at_cells(wedges_[index], lit, request_.lattice);
    std::ranges::copy(edges.pieces(index, *edges.meeting(index), lit, parts, {edges.towards()}), std::back_inserter(pieces_));
  }

  ScatteringMatrix scattering_of(std::uint32_t index, std::span<const LitInterval> lit, std::span<const double> frequencies,
                                 std::size_t frequency_index) const {
    auto edges = make_(frequencies);
    edges.add(index, *edges.meeting(index), lit);
    const EdgeLookResult result = edges.take();
    ScatteringMatrix sum = result.scattering[frequency_index];
    if (!result.higher.empty()) sum += result.higher[frequency_index];
    return sum;
  }

  std::span<const Wedge> wedges_;
  std::span<const double> frequencies_;
  PieceRequest request_;
  MakeEdges make_;
  std::vector<ImageEdge> pieces_;
};

}  // namespace raytube
