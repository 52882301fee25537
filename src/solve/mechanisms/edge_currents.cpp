#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "plan/material_edges.h"
#include "solve/mechanisms/band_scene.h"
#include "solve/mechanisms/list.h"
#include "uncertainty/omissions.h"

namespace raytube {

namespace {

constexpr double outlines_per_wedges = 1.0;  // the outlines of the faces beside them take about as much as the wedges

/// What tells edges between perfect conductors and edges beside other materials apart.
struct KindOfEdges {
  EdgeKind kind;
  const char *counted, *windowed;  // names of counts in run.json
  const char* looks_without;
};
constexpr KindOfEdges of_conductors{EdgeKind::conductors, "wedges_lit", "windowed_rows", "looks without edge currents"};
constexpr KindOfEdges of_materials{EdgeKind::materials, "material_edges_lit", "windowed_rows_of_materials",
                                   "looks without currents of edges of materials"};

// `on`: some edge of the target radiates, at some frequency.
Contribution contribution_of(const KindOfEdges& of, EdgeLookResult found, bool on) {
  Contribution result{.work = found.work};
  result.s = {std::move(found.scattering), std::move(found.higher)};
  const auto windowed = static_cast<std::uint64_t>(std::ranges::count(found.windowed, true));
  result.counts = {
      {.what = of.counted, .count = found.wedges_lit, .fold = Fold::most},
      {.what = of.windowed, .count = windowed},
      {of.looks_without, on ? "no edge is lit" : "no edge of the target can radiate", found.lit ? 0u : 1u, Fold::least}};
  return result;
}

class EdgeCurrentsOfLook : public Mechanism {
 public:
  EdgeCurrentsOfLook(const BandScene& scene, const KindOfEdges& of, bool on) : scene_(scene), of_(of), on_(on) {}

  Contribution solve(const TracedLook& traced, const std::vector<bool>&, LookSink& sink) const override {
    if (!scene_.edges.radiate(of_.kind) && scene_.plan.tubes.skip) return contribution_of(of_, {}, on_);
    const Look& look = traced.look;
    const WavesAtEdges waves{sink.arrivals, sink.waves_run};
    if (sink.image) return add_pieces(look, waves, *sink.image), Contribution();  // nobody asks for their sum
    return contribution_of(of_, scene_.edges.scattering(look, scene_.plan.sweep.radar, waves, of_.kind), on_);
  }

  void trace(const Look& look, std::vector<SurfaceArrival>& arrivals, std::vector<SurfaceRay>& rays) const override {
    if (scene_.curved && of_.kind == EdgeKind::conductors)
      std::ranges::copy(scene_.edges.surface_rays(look, scene_.plan.sweep.radar, arrivals), std::back_inserter(rays));
  }

 private:
  void add_pieces(const Look& look, const WavesAtEdges& waves, ImageRequest& image) const {
    const Radar& radar = scene_.plan.sweep.radar;
    const PieceRequest request{image.frequency_index, image.lattice, image.by_path};
    std::ranges::move(scene_.edges.pieces(look, radar, request, waves, of_.kind), std::back_inserter(image.pieces));
    if (of_.kind == EdgeKind::conductors)
      std::ranges::move(scene_.edges.arrival_pieces(look, radar, request, waves.arrivals), std::back_inserter(image.pieces));
  }

  const BandScene& scene_;
  const KindOfEdges& of_;
  const bool on_;
};

// Without any that radiate the pass is made where nothing is to be skipped; that no edge radiates is told once.
std::unique_ptr<Mechanism> make_edges(const BandScene& scene) {
  if (!scene.plan.fringe()) return nullptr;
  const bool materials_alone = scene.edges.radiate(EdgeKind::materials) && !scene.edges.radiate(EdgeKind::conductors);
  if (materials_alone && scene.plan.tubes.skip) return nullptr;
  return std::make_unique<EdgeCurrentsOfLook>(scene, of_conductors, scene.plan.state("edges").on);
}

std::unique_ptr<Mechanism> make_material_edges(const BandScene& scene) {
  if (!scene.plan.fringe() || !scene.edges.radiate(EdgeKind::materials)) return nullptr;
  return std::make_unique<EdgeCurrentsOfLook>(scene, of_materials, true);
}

void tell_edges(const SolvePlan&, const Contribution& edges, std::size_t frequency, RowEvidence& row) {
  row.edges += edges.at(0, frequency), row.higher += edges.at(1, frequency);
}

// Sets of wedges beside the mesh's own.
double bytes_of_edges(const SolvePlan& plan) {
  if (!plan.fringe()) return 0.0;
  double bytes = 0.0;
  for (const WedgeSet& set : plan.wedge_sets)
    if (!set.as_given()) bytes += static_cast<double>(set.wedges->size() * sizeof(Wedge)) * (1.0 + outlines_per_wedges);
  return bytes;
}

std::string remedy_of_edges(const SolvePlan& plan, const MechanismShown& shown) {
  const bool materials = !plan.sweep.materials.empty();
  if (!plan.fringe()) return more_edge_currents;
  if (materials && plan.edges.materials == MaterialEdgeMethod::none) return "edges.materials = \"fringe\", at little cost";
  const bool straight_over_curved = !plan.surfaces.waves.possible() && shown.curved_edges > worth_naming;
  if (straight_over_curved && !materials) return more_surface_waves;
  return "none; use a full-wave method where such edges matter";
}

// Up to the order beyond which the omission no longer falls.
template <Omission omission, int best_order>
std::string remedy_of_order(const SolvePlan& plan, const MechanismShown&) {
  if (!plan.fringe()) return more_edge_currents;
  if (plan.edges.order >= best_order) return text_of(omission).remedy;
  return fmt::format("edges.order = {}, a few times the time of the edges", best_order);
}

double bound_of_edges(const AmplitudeLimits& limits) { return limits.edges; }
// As much again for every further edge in a row.
double bound_of_further_edges(const AmplitudeLimits& limits) { return (limits.edge_order - 1) * limits.edges; }

}  // namespace

MechanismState edge_currents_state(const SolvePlan& plan) {
  if (!plan.fringe()) return without(plan.rays() ? "edges.method is \"utd\"" : "edges.method is \"none\"");
  if (std::ranges::none_of(plan.target.wedges, &Wedge::radiates))
    return without("the target has no convex edge between perfect conductors");
  return {.on = true, .forced = true, .what = fmt::format("order {}", plan.edges.order)};
}

MechanismState material_edges_state(const SolvePlan& plan) {
  if (!plan.fringe()) return without(edge_currents_state(plan).why_not);
  const MaterialEdgeCount count = count_material_edges(plan.target, plan.sweep, plan.edges);
  if (count.computed > 0)
    return {.on = true, .forced = true, .what = fmt::format("{} edges, order {}", count.computed, plan.edges.order)};
  if (count.known > 0) return misses("edges.materials is \"none\"");
  return without(count.of_solids > 0 ? "edges of solids add nothing"
                                     : "the target has no convex edge of other materials whose currents are known");
}

MechanismEntry edge_currents_entry() {
  return {.name = "edges",
          .label = "edge currents",
          .key = "edges.method",
          .budget_key = nullptr,
          .columns = {{"edges_order_1", "edges, order 1", bound_of_edges},
                      {"edges_order_2_on", "edges, orders 2 and 3 (edges.order)", bound_of_further_edges}},
          .counts = {of_conductors.counted, of_conductors.windowed},
          .state = edge_currents_state,
          .make = make_edges,
          .bytes = bytes_of_edges,
          .tell = tell_edges,
          .remedies = {{Omission::corners, remedy_of_order<Omission::corners, 2>},  // where a face of the next edge ends
                       {Omission::edge_orders, remedy_of_order<Omission::edge_orders, 3>},
                       {Omission::edges, remedy_of_edges}}};
}

MechanismEntry material_edges_entry() {
  return {.name = "material_edges",
          .label = "edges of materials",
          .key = "edges.materials",
          .budget_key = nullptr,
          .columns = {{"material_edges_order_1", "edges of materials, order 1 (edges.materials)", bound_of_edges},
                      {"material_edges_order_2_on", "edges of materials, orders 2 and 3", bound_of_further_edges}},
          .counts = {of_materials.counted, of_materials.windowed},
          .state = material_edges_state,
          .make = make_material_edges,
          .tell = tell_edges};
}

}  // namespace raytube
