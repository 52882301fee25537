#include "solve/mechanisms/edge_currents.h"

#include <algorithm>
#include <iterator>

#include "uncertainty/omissions.h"
#include "utd/corner/corner_waves.h"

namespace raytube {

namespace {

constexpr double outlines_per_wedges = 1.0;  // the outlines of the faces beside them take about as much as the wedges

// `on`: some edge of the target radiates, at some frequency.
Contribution contribution_of(EdgeLookResult found, bool on) {
  Contribution result{.work = found.work};
  result.s = {std::move(found.scattering), std::move(found.higher)};
  const auto windowed = static_cast<std::uint64_t>(std::ranges::count(found.windowed, true));
  result.counts = {{.what = "wedges_lit", .count = found.wedges_lit, .fold = Fold::most},
                   {.what = "windowed_rows", .count = windowed},
                   {"looks without edge currents", on ? "no edge is lit" : "no edge of the target can radiate",
                    found.lit ? 0u : 1u, Fold::least}};
  return result;
}

class EdgeCurrentsOfLook : public Mechanism {
 public:
  explicit EdgeCurrentsOfLook(const BandScene& scene) : scene_(scene), on_(scene.plan.state("edges").on) {}

  Prospect prospect(const TracedLook&) const override { return {}; }

  Contribution solve(const TracedLook& traced, const std::vector<bool>&, LookSink& sink) const override {
    if (!scene_.edges.radiate() && scene_.plan.tubes.skip) return contribution_of({}, on_);
    const Look& look = traced.look;
    const WavesAtEdges waves{sink.arrivals, sink.waves_run};
    if (sink.image) return add_pieces(look, waves, *sink.image), Contribution();  // nobody asks for their sum
    return contribution_of(scene_.edges.scattering(look, scene_.plan.sweep.radar, waves), on_);
  }

  void trace(const Look& look, std::vector<SurfaceArrival>& arrivals, std::vector<SurfaceRay>& rays) const override {
    if (scene_.curved)
      std::ranges::copy(scene_.edges.surface_rays(look, scene_.plan.sweep.radar, arrivals), std::back_inserter(rays));
  }

 private:
  void add_pieces(const Look& look, const WavesAtEdges& waves, ImageRequest& image) const {
    const PieceRequest request{image.frequency_index, image.lattice, image.by_path};
    std::ranges::move(scene_.edges.pieces(look, scene_.plan.sweep.radar, request, waves), std::back_inserter(image.pieces));
    std::ranges::move(scene_.edges.arrival_pieces(look, scene_.plan.sweep.radar, request, waves.arrivals),
                      std::back_inserter(image.pieces));
  }

  const BandScene& scene_;
  const bool on_;
};

}  // namespace

// Without any that radiate the pass is made where nothing is to be skipped.
std::unique_ptr<Mechanism> make_edge_currents(const BandScene& scene) {
  return scene.plan.fringe() ? std::make_unique<EdgeCurrentsOfLook>(scene) : nullptr;
}

void tell_edge_currents(const SolvePlan&, const Contribution& edges, std::size_t frequency, RowEvidence& row) {
  row.edges = edges.at(0, frequency), row.higher = edges.at(1, frequency);
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
