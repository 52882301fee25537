#include "solve/mechanisms/beside_waves.h"
#include "solve/mechanisms/list.h"
#include "utd/tip/tip_waves.h"

namespace raytube {

namespace {

constexpr const char* sides_of_round_tips = "round_tip_sides";

MechanismState state_of_round_tips(const SolvePlan& plan) {
  return state_beside_waves(plan, "surfaces.round_tips", plan.surfaces.round_tips, "at tips of cones");
}

std::unique_ptr<Mechanism> make_round_tips(const BandScene& scene) {
  if (scene.round_tips.empty()) return nullptr;
  return beside_waves(scene, sides_of_round_tips, [&scene](LocalLook& look, std::size_t frequency, StripPlaces* places) {
    return tip_scattering(*scene.curved, scene.round_tips, look, wavenumber(scene.band.frequencies[frequency]), places);
  });
}

}  // namespace

MechanismEntry round_tips_entry() {
  return {.name = "round_tips",
          .label = "round tips",
          .key = "surfaces.round_tips",
          .budget_key = nullptr,
          .follows = "surface_waves",
          .columns = {{"round_tips", "round tips (surfaces.round_tips)", bound_on_curved_surfaces}},
          .counts = {sides_of_round_tips},
          .state = state_of_round_tips,
          .make = make_round_tips,
          .tell = tell_beside_waves};
}

}  // namespace raytube
