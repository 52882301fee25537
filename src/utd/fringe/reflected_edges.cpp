#include "utd/fringe/reflected_edges.h"

#include <algorithm>
#include <cassert>

#include "utd/fringe/edge_pass.h"

namespace raytube {

namespace {

// The weights of its edges, each once.
std::vector<double> weights_of(const ReflectedLook& look) {
  std::vector<double> weights;
  for (const LitWedge& edge : look.edges) weights.push_back(edge.weight);
  std::ranges::sort(weights);
  weights.erase(std::unique(weights.begin(), weights.end()), weights.end());
  return weights;
}

ScatteringMatrix of_transmitter(const ReflectedLook& look, const ScatteringMatrix& s, std::size_t frequency) {
  return look.weights.empty() ? s : times(s, look.weights[frequency]);
}

void add_weighted(EdgeLookResult& sum, const EdgeLookResult& part, const ReflectedLook& look, double weight,
                  std::span<const double> frequencies) {
  for (std::size_t f = 0; f < frequencies.size(); ++f) {
    const Complex factor = std::polar(weight, -wavenumber(frequencies[f]) * look.path);
    add_product(sum.scattering[f], of_transmitter(look, part.scattering[f], f), factor);
    add_product(sum.higher[f], of_transmitter(look, part.higher[f], f), factor);
    if (part.windowed[f]) sum.windowed[f] = true;
  }
  sum.lit = sum.lit || part.lit;
  sum.wedges_lit += part.wedges_lit;
  sum.work += part.work;
}

}  // namespace

EdgeLookResult reflected_fringe_scattering(const EdgeScene& scene, std::span<const ReflectedLook> looks,
                                           std::span<const double> frequencies, const FringeOptions& options) {
  assert(!frequencies.empty() && options.order >= 1);
  EdgeLookResult result;
  result.scattering.resize(frequencies.size());
  result.higher.resize(frequencies.size());
  result.windowed.resize(frequencies.size());
  for (const ReflectedLook& look : looks)
    for (const double weight : weights_of(look)) {
      StripEdges edges(scene, look.look, frequencies, options);
      for (const LitWedge& edge : look.edges)
        if (const auto meeting = edges.meeting(edge.wedge); meeting && edge.weight == weight && !edge.lit.empty())
          edges.add(edge.wedge, *meeting, edge.lit);
      add_weighted(result, edges.take(), look, weight, frequencies);
    }
  return result;
}

std::vector<ImageEdge> reflected_fringe_pieces(const EdgeScene& scene, const ReflectedLook& look,
                                               std::span<const double> frequencies, const FringeOptions& options,
                                               PathPlace place) {
  std::vector<ImageEdge> all;
  place.path = look.path;
  for (const LitWedge& edge : look.edges) {
    StripEdges edges(scene, look.look, frequencies, options);
    const auto meeting = edges.meeting(edge.wedge);
    if (!meeting || edge.lit.empty()) continue;
    for (ImageEdge& piece : edges.pieces(edge.wedge, *meeting, edge.lit, edge.lit, place)) {
      piece.s = of_transmitter(look, piece.s, 0);
      piece.s *= std::polar(edge.weight, -wavenumber(frequencies.front()) * look.path);
      all.push_back(piece);
    }
  }
  return all;
}

}  // namespace raytube
