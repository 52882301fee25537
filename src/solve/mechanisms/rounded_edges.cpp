#include <algorithm>
#include <map>

#include "solve/mechanisms/beside_waves.h"
#include "solve/mechanisms/list.h"
#include "utd/rounded/rims.h"

namespace raytube {

namespace {

constexpr const char* pieces_of_rounded_edges = "rounded_edge_pieces";

MechanismState state_of_rounded_edges(const SolvePlan& plan) {
  return state_beside_waves(plan, "surfaces.rounded_edges", plan.surfaces.rounded_edges, "at bends sharper than k rho = 3");
}

std::unique_ptr<Mechanism> make_rounded_edges(const BandScene& scene) {
  if (!scene.curved) return nullptr;
  std::map<double, std::vector<Nose>> noses;
  std::vector<std::vector<RimPiece>> rims;  // [frequency]
  for (const double frequency : scene.band.frequencies) {
    const auto [found, is_new] = noses.try_emplace(longest_nose(frequency));
    if (is_new) found->second = scene.curved->short_noses(found->first);
    rims.push_back(rim_pieces(found->second, wavenumber(frequency)));
  }
  if (std::ranges::all_of(rims, &std::vector<RimPiece>::empty)) return nullptr;
  return beside_waves(scene, pieces_of_rounded_edges,
                      [&scene, rims = std::move(rims)](LocalLook& look, std::size_t frequency, StripPlaces* places) {
                        const double k = wavenumber(scene.band.frequencies[frequency]);
                        return rim_scattering(*scene.curved, rims[frequency], look, k, places);
                      });
}

// The bends of all facets.
double bytes_of_rounded_edges(const SolvePlan& plan) {
  const auto with_waves = std::ranges::count_if(plan.bands, [&](const BandPlan& b) { return has_surface_waves(plan, b); });
  return static_cast<double>(with_waves) * static_cast<double>(plan.target.mesh.triangles.size() * sizeof(Nose));
}

}  // namespace

MechanismEntry rounded_edges_entry() {
  return {.name = "rounded_edges",
          .label = "rounded edges",
          .key = "surfaces.rounded_edges",
          .budget_key = nullptr,
          .follows = "surface_waves",
          .columns = {{"rounded_edges", "rounded edges (surfaces.rounded_edges)", bound_on_curved_surfaces}},
          .counts = {pieces_of_rounded_edges},
          .state = state_of_rounded_edges,
          .make = make_rounded_edges,
          .bytes = bytes_of_rounded_edges,
          .tell = tell_beside_waves};
}

}  // namespace raytube
