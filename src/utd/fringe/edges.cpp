#include "utd/fringe/edges.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "utd/fringe/edge_pass.h"
#include "utd/shadow/lit_edges.h"

namespace raytube {

namespace {

/// All lit edges, in their order.
template <class Edges>
EdgeLookResult sum_of(Edges edges, std::size_t count, LitEdges& light) {
  for (std::uint32_t index = 0; index < count; ++index)
    if (const auto meeting = edges.meeting(index); meeting && light.find(index, meeting->incidence))
      edges.add(index, *meeting, light.lit());
  return edges.take();
}

/// The weights of its pieces, each once.
std::vector<double> weights_of(const ReflectedLook& look) {
  std::vector<double> weights;
  for (const LitPieces& pieces : look.pieces) weights.push_back(pieces.weight);
  std::ranges::sort(weights);
  weights.erase(std::unique(weights.begin(), weights.end()), weights.end());
  return weights;
}

void add_weighted(EdgeLookResult& sum, const EdgeLookResult& part, double path, double weight,
                  std::span<const double> frequencies) {
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const Complex factor = std::polar(weight, -wavenumber(frequencies[i]) * path);
    add_product(sum.scattering[i], part.scattering[i], factor);
    add_product(sum.higher[i], part.higher[i], factor);
    if (part.windowed[i]) sum.windowed[i] = true;
  }
  sum.lit = sum.lit || part.lit;
  sum.wedges_lit += part.wedges_lit;
}

}  // namespace

EdgeLookResult fringe_scattering(std::span<const Wedge> wedges, const Tracer& tracer, const Look& look,
                                 std::span<const double> frequencies, bool receiver_shadow) {
  assert(!frequencies.empty());
  const LookVectors vectors = look_vectors(look);
  LitEdges light(wedges, tracer, vectors, shortest_wavelength(frequencies), receiver_shadow);
  return sum_of(FirstOrderEdges(wedges, vectors, frequencies), wedges.size(), light);
}

EdgeLookResult fringe_scattering(std::span<const Wedge> wedges, const Outlines& outlines, const Tracer& tracer, const Look& look,
                                 std::span<const double> frequencies, int order, bool receiver_shadow, TransitionTier tier,
                                 bool continue_by_images) {
  assert(!frequencies.empty() && order > 1);
  const LookVectors vectors = look_vectors(look);
  LitEdges light(wedges, tracer, vectors, shortest_wavelength(frequencies), receiver_shadow);
  return sum_of(StripPass(wedges, outlines, vectors, frequencies, order, tier, continue_by_images), wedges.size(), light);
}

EdgeLookResult reflected_fringe_scattering(std::span<const Wedge> wedges, const Outlines& outlines,
                                           std::span<const ReflectedLook> looks, std::span<const double> frequencies, int order,
                                           TransitionTier tier, bool continue_by_images) {
  assert(!frequencies.empty() && order >= 1);
  EdgeLookResult result;
  result.scattering.resize(frequencies.size());
  result.higher.resize(frequencies.size());
  result.windowed.resize(frequencies.size());
  for (const ReflectedLook& look : looks)
    for (const double weight : weights_of(look)) {
      StripPass pass(wedges, outlines, look.look, frequencies, order, tier, continue_by_images);
      for (const LitPieces& pieces : look.pieces)
        if (const auto meeting = pass.meeting(pieces.wedge); meeting && pieces.weight == weight && !pieces.lit.empty())
          pass.add(pieces.wedge, *meeting, pieces.lit);
      add_weighted(result, pass.take(), look.path, weight, frequencies);
    }
  return result;
}

}  // namespace raytube
