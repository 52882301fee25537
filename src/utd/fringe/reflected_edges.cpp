#include "utd/fringe/reflected_edges.h"

#include <algorithm>
#include <cassert>

#include "utd/fringe/edge_sum.h"

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

// S to the transmitter's own fields, of the wave as it has come over the mirrors.
ScatteringMatrix of_transmitter(const ReflectedLook& look, const ScatteringMatrix& s, double weight, double frequency,
                                std::size_t index) {
  ScatteringMatrix result = look.weights.empty() ? s : times(s, look.weights[index]);
  return result *= std::polar(weight, -wavenumber(frequency) * look.path);
}

std::optional<LitEdge> lit_edge(const EdgeScene& scene, const ReflectedLook& look, const LitWedge& edge,
                                const FringeOptions& options) {
  const auto met = meeting(scene, edge.wedge, look.look.incident, options);
  return met && !edge.lit.empty() ? std::optional<LitEdge>({edge.wedge, *met, edge.lit}) : std::nullopt;
}

}  // namespace

EdgeLookResult reflected_fringe_scattering(const EdgeScene& scene, std::span<const ReflectedLook> looks,
                                           std::span<const double> frequencies, const FringeOptions& options) {
  assert(!frequencies.empty() && options.order > 1);
  EdgeLookResult result(frequencies.size(), options.order);
  for (const ReflectedLook& look : looks)
    for (const double weight : weights_of(look)) {
      EdgeSum sum(scene, look.look, frequencies, options);
      for (const LitWedge& edge : look.edges)
        if (const auto lit = lit_edge(scene, look, edge, options); lit && edge.weight == weight)
          sum.add(*lit), result.wedges_lit += !lit->meeting.edge_face_only;
      result.add(sum.take(),
                 [&](const ScatteringMatrix& s, std::size_t f) { return of_transmitter(look, s, weight, frequencies[f], f); });
    }
  return result;
}

std::vector<ImageEdge> reflected_fringe_pieces(const EdgeScene& scene, const ReflectedLook& look,
                                               std::span<const double> frequencies, const FringeOptions& options,
                                               PathPlace place) {
  std::vector<ImageEdge> all;
  place.path = look.path;
  for (const LitWedge& edge : look.edges) {
    const auto lit = lit_edge(scene, look, edge, options);
    if (!lit) continue;
    for (ImageEdge& piece : EdgeSum(scene, look.look, frequencies, options).pieces(*lit, edge.lit, place)) {
      piece.s = of_transmitter(look, piece.s, edge.weight, frequencies.front(), 0);
      all.push_back(piece);
    }
  }
  return all;
}

}  // namespace raytube
