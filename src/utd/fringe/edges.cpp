#include "utd/fringe/edges.h"

#include <cassert>
#include <map>

#include "core/threads.h"
#include "utd/fringe/edge_groups.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

// Each edge of several wedges once.
void add_corner_waves(EdgesInLook& edges, const EdgeScene& scene, std::span<const double> frequencies, EdgeLookResult& sum) {
  struct Wave {
    double share = 0.0;
    dvec3 middle{0.0};
  };
  std::map<std::pair<std::uint32_t, Screens>, Wave> waves;
  edges.visit_corner_waves([&](const CornerWaveGroup& group) {
    Wave& wave = waves.try_emplace({scene.corners->first_of(group.wedge), group.screens}, Wave{0.0, group.middle}).first->second;
    wave.share += share_of(group.lit) * group.part;
  });
  for (const auto& [key, wave] : waves) {
    if (wave.share == 0.0) continue;
    sum.work += work::corner_wave;
    std::vector<ScatteringMatrix> s(frequencies.size());
    edges.add_corner_waves(key.first, wave.share, frequencies, s);
    for (std::size_t f = 0; f < s.size(); ++f) sum.higher[f] += edges.behind(key.second, wave.middle, s[f], f);
  }
}

// The lit parts of an edge, cut where it goes from one cell into another.
std::vector<LitInterval> cut_at_cells(const Wedge& wedge, std::span<const LitInterval> lit, const ImageLattice& lattice) {
  std::vector<LitInterval> parts;
  for (const auto& [begin, end] : lit) {
    const std::vector<double> shares = lattice.crossings(wedge.at(begin), wedge.at(end));
    for (std::size_t i = 1; i < shares.size(); ++i)
      parts.push_back({begin + shares[i - 1] * (end - begin), begin + shares[i] * (end - begin)});
  }
  return parts;
}

std::vector<ImageEdge> pieces_of_edge(const EdgeScene& scene, const LookVectors& look, const LitEdge& edge,
                                      std::span<const double> frequencies, const PieceRequest& request,
                                      const FringeOptions& options) {
  const Wedge& wedge = scene.wedges[edge.wedge];
  const std::vector<LitInterval> parts = cut_at_cells(wedge, edge.lit, request.lattice);
  if (request.by_path && options.order > 1 && !edge.meeting.of_materials)
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

std::vector<ImageEdge> pieces_of_corner_waves(const EdgesInLook& edges, const EdgeScene& scene, const EdgeLook& look,
                                              const CornerWaveGroup& group, double frequency, const PieceRequest& request) {
  ScatteringMatrix whole;
  edges.add_corner_waves(group.wedge, group.part, std::span(&frequency, 1), std::span(&whole, 1));
  whole = edges.behind(group.screens, group.middle, whole, request.frequency_index);
  const auto times = [&](double share) {
    ScatteringMatrix s = whole;
    return s *= share;
  };
  if (request.by_path) {
    const dvec3 place = scene.corners->place(group.wedge, look.at(group.middle).scattered);
    return {{place, place, times(share_of(group.lit))}};
  }
  const Wedge& wedge = scene.wedges[group.wedge];
  std::vector<ImageEdge> pieces;
  for (const LitInterval& part : cut_at_cells(wedge, group.lit, request.lattice))
    pieces.push_back({wedge.at(part.begin), wedge.at(part.end), times(part.end - part.begin)});
  return pieces;
}

}  // namespace

double add_arrivals(const EdgeScene& scene, const EdgeLook& look, std::span<const double> frequencies,
                    const FringeOptions& options, const SurfaceLight& light, std::span<ScatteringMatrix> scattering) {
  if (options.order == 1 || scene.curved == nullptr || light.arrivals.empty()) return 0.0;
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
  add_corner_waves(edges, scene, subset.frequencies, sum);
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
  edges.visit_corner_waves([&](const CornerWaveGroup& group) {
    const double frequency = subset.frequencies[request.frequency_index];
    std::ranges::copy(pieces_of_corner_waves(edges, scene, look, group, frequency, request), std::back_inserter(pieces));
  });
  return pieces;
}

}  // namespace raytube
