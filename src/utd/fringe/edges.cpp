#include "utd/fringe/edges.h"

#include <cassert>

#include "core/threads.h"
#include "utd/fringe/edge_groups.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

std::vector<ImageEdge> pieces_of_edge(const EdgeScene& scene, const LookVectors& look, const LitEdge& edge,
                                      std::span<const double> frequencies, const PieceRequest& request,
                                      const FringeOptions& options) {
  const Wedge& wedge = scene.wedges[edge.wedge];
  const std::vector<LitInterval> parts = cut_at_cells(wedge, edge.lit, request.lattice);
  if (request.by_path && options.order > 1 && !options.of_materials)
    return EdgeSum(scene, look, frequencies, options).pieces(edge, parts, {look.scattered});
  const auto scattering_of = [&](std::span<const LitInterval> lit, std::span<const double> at, std::size_t index) {
    EdgeSum sum(scene, look, at, options);
    sum.add({edge.wedge, edge.meeting, {lit.begin(), lit.end()}});
    const EdgeLookResult result = sum.take();
    return result.higher.empty() ? result.scattering[index] : result.scattering[index] + result.higher[index];
  };
  const ScatteringMatrix all = scattering_of(edge.lit, frequencies, request.frequency_index);
  if (parts.size() == 1) return {{wedge.at(parts[0].begin), wedge.at(parts[0].end), all}};
  ScatteringMatrix rest = all;
  std::vector<ImageEdge> pieces;
  for (const LitInterval& part : parts) {
    const ScatteringMatrix s = scattering_of(std::span(&part, 1), frequencies.subspan(request.frequency_index, 1), 0);
    pieces.push_back({wedge.at(part.begin), wedge.at(part.end), s});
    rest = rest - s;
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    ScatteringMatrix share = rest;
    pieces[i].s += share *= (parts[i].end - parts[i].begin) / share_of(parts);
  }
  return pieces;
}

}  // namespace

double add_arrivals(const EdgeScene& scene, const EdgeLook& look, std::span<const double> frequencies,
                    const FringeOptions& options, const SurfaceLight& light, std::span<ScatteringMatrix> scattering) {
  if (options.order == 1 || options.of_materials || scene.curved == nullptr) return 0.0;
  double work = 0.0;
  const std::size_t together = look.far() ? light.arrivals.size() : 1;  // in the same waves
  for (std::size_t first = 0; first < light.arrivals.size(); first += together) {
    const LookVectors vectors = look.at(light.arrivals[first].position);
    MultipleDiffraction strips(scene.wedges, scene.outlines, scene.curved, vectors, frequencies, options.order);
    strips.keep_rays(options.rays);
    for (const SurfaceArrival& arrival : light.arrivals.subspan(first, together)) strips.arrive(arrival, light.frequencies);
    const StripSums sums = strips.take();
    for (std::size_t f = 0; f < frequencies.size(); ++f) scattering[f] += sums.higher[f];
    work += sums.work;
  }
  return work;
}

EdgeLookResult fringe_scattering(const EdgeScene& scene, const EdgeLook& look, const SweepSubset& subset,
                                 const FringeOptions& options, const SurfaceLight& light) {
  assert(!subset.frequencies.empty() && options.order >= 1);
  EdgeLookResult sum(subset.frequencies.size(), options.order);
  EdgesInLook edges(scene, look, subset, options);
  sum.wedges_lit = edges.visit_groups([&](const EdgeGroup& group) {
    stop_if_cancelled();
    EdgeSum part(scene, group.look, subset.frequencies, options);
    for (const LitEdge& edge : group.edges) part.add(edge);
    sum.add(part.take(), [&](const ScatteringMatrix& s, std::size_t f) { return edges.received(group, s, f); });
  });
  sum.work += add_arrivals(scene, look, subset.frequencies, options, light, sum.higher);
  sum.work += edges.work();
  return sum;
}

std::vector<ImageEdge> fringe_pieces(const EdgeScene& scene, const EdgeLook& look, const SweepSubset& subset,
                                     const PieceRequest& request, const FringeOptions& options) {
  std::vector<ImageEdge> pieces;
  EdgesInLook edges(scene, look, subset, options);
  edges.visit_groups([&](const EdgeGroup& group) {
    for (const LitEdge& edge : group.edges)
      for (ImageEdge& piece : pieces_of_edge(scene, group.look, edge, subset.frequencies, request, options)) {
        piece.s = edges.received(group, piece.s, request.frequency_index);
        pieces.push_back(piece);
      }
  });
  return pieces;
}

}  // namespace raytube
