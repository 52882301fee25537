#include <algorithm>
#include <map>

#include "scene/frequency_bands.h"
#include "solve/mechanisms/beside_waves.h"
#include "solve/mechanisms/list.h"
#include "utd/tip/flat_tip_waves.h"

namespace raytube {

namespace {

constexpr const char* points_of_flat_tips = "flat_tip_points";

MechanismState state_of_flat_tips(const SolvePlan& plan) {
  const bool rims = plan.surfaces.rounded_edges;
  return state_beside_waves(plan, rims ? "surfaces.flat_tips" : "surfaces.rounded_edges", rims && plan.surfaces.flat_tips,
                            "at tips in which rounded edges meet");
}

std::unique_ptr<Mechanism> make_flat_tips(const BandScene& scene) {
  if (!scene.curved || !scene.plan.surfaces.flat_tips) return nullptr;
  std::map<long, FlatTipWaves> tips;  // by band_of()
  for (const double frequency : scene.band.frequencies)
    if (const long band = band_of(frequency); !tips.contains(band))
      tips.try_emplace(band, find_flat_tips(*scene.curved, wavelength(middle_of_band(band))));
  if (std::ranges::all_of(tips, [](const auto& of_band) { return of_band.second.empty(); })) return nullptr;
  return beside_waves(scene, points_of_flat_tips,
                      [&scene, tips = std::move(tips)](LocalLook& look, std::size_t i, StripPlaces* places) {
                        const double frequency = scene.band.frequencies[i];
                        return tips.at(band_of(frequency)).scattering(*scene.curved, look, wavenumber(frequency), places);
                      });
}

}  // namespace

MechanismEntry flat_tips_entry() {
  return {.name = "flat_tips",
          .label = "flat tips",
          .key = "surfaces.flat_tips",
          .budget_key = nullptr,
          .follows = "surface_waves",
          .columns = {{"flat_tips", "flat tips (surfaces.flat_tips)", bound_on_curved_surfaces}},
          .counts = {points_of_flat_tips},
          .state = state_of_flat_tips,
          .make = make_flat_tips,
          .tell = tell_beside_waves};
}

}  // namespace raytube
