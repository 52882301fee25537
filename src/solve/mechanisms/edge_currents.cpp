#include "solve/mechanisms/edge_currents.h"

#include <algorithm>
#include <iterator>

#include "utd/corner/corner_waves.h"

namespace raytube {

namespace {

constexpr double outlines_per_wedges = 1.0;  // the outlines of the faces beside them take about as much as the wedges

void put(EdgeLookResult found, LookSums& sums) {
  sums.s[Part::edges_first] = std::move(found.scattering);
  sums.s[Part::edges_higher] = std::move(found.higher);
  sums.windowed = std::move(found.windowed);
  sums.wedges_lit = found.wedges_lit;
  sums.edges_lit = found.lit;
}

class EdgeCurrentsOfLook : public Mechanism {
 public:
  explicit EdgeCurrentsOfLook(const BandScene& scene) : scene_(scene) {}

  Prospect prospect(const TracedLook&, const LookSums&) const override { return {}; }

  void solve(const TracedLook& traced, const std::vector<bool>&, LookSink& sink) const override {
    const Look& look = traced.look;
    const WavesAtEdges waves{sink.arrivals, sink.sums.run(MechanismId::surface_waves).ran};
    EdgeLookResult found = scene_.edges.scattering(look, scene_.plan.sweep.radar, waves);
    sink.sums.run(MechanismId::edge_currents).work = found.work;
    put(std::move(found), sink.sums);
    if (sink.image == nullptr) return;
    const PieceRequest request{sink.image->frequency_index, sink.image->lattice, sink.image->by_path};
    std::vector<ImageEdge>& pieces = sink.image->pieces;
    std::vector<ImageEdge> edges = scene_.edges.pieces(look, scene_.plan.sweep.radar, request, waves);
    if (pieces.empty())
      pieces = std::move(edges);  // there may be many
    else
      std::ranges::copy(edges, std::back_inserter(pieces));
    std::ranges::copy(scene_.edges.arrival_pieces(look, scene_.plan.sweep.radar, request, sink.arrivals),
                      std::back_inserter(pieces));
  }

  void trace(const Look& look, std::vector<SurfaceArrival>& arrivals, std::vector<SurfaceRay>& rays) const override {
    if (scene_.curved)
      std::ranges::copy(scene_.edges.surface_rays(look, scene_.plan.sweep.radar, arrivals), std::back_inserter(rays));
  }

 private:
  const BandScene& scene_;
};

}  // namespace

// Without any that radiate the pass is made where nothing is to be skipped.
std::unique_ptr<Mechanism> make_edge_currents(const BandScene& scene) {
  if (!scene.plan.fringe() || (!scene.edges.radiate() && scene.plan.tubes.skip)) return nullptr;
  return std::make_unique<EdgeCurrentsOfLook>(scene);
}

// Sets of wedges beside the mesh's own, and the solved corners of plates.
double edge_currents_bytes(const SolvePlan& plan) {
  if (!plan.fringe()) return 0.0;
  double bytes = 0.0;
  for (const WedgeSet& set : plan.wedge_sets) {
    if (!set.as_given()) bytes += static_cast<double>(set.wedges->size() * sizeof(Wedge)) * (1.0 + outlines_per_wedges);
    if (plan.edges.order > 1) bytes += static_cast<double>(CornerWaves(*set.wedges).bytes());
  }
  return bytes;
}

}  // namespace raytube
