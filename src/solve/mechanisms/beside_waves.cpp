#include "solve/mechanisms/beside_waves.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "scene/frequency_bands.h"
#include "uncertainty/omissions.h"

namespace raytube {

namespace {

std::optional<AntennaPair> antennas_of(const BandScene& scene, const Look& look) {
  if (look.far()) return std::nullopt;
  return AntennaPair(look, scene.plan.sweep.radar, scene.plan.target.mesh.center);
}

LocalLook local_look(const BandScene& scene, const Look& look, const std::optional<AntennaPair>& antennas) {
  if (!antennas) return look_vectors(look);
  return NearLook(near_antennas(*antennas), wavenumber(sampling_frequency(scene.band.frequencies)),
                  scene.plan.target.mesh.radius);
}

class SumBesideWaves : public Mechanism {
 public:
  SumBesideWaves(const BandScene& scene, const char* count, SumAtFrequency sum)
      : scene_(scene), count_(count), sum_(std::move(sum)) {}

  Contribution solve(const TracedLook& traced, const std::vector<bool>& wanted, LookSink& sink) const override {
    LookFromAntennas look(scene_, traced.look);
    std::optional<StripPlaces> places = places_in_image(traced.look, wanted, sink);
    std::vector<ScatteringMatrix> s(wanted.size());
    CountedSum all;
    for (std::size_t f = 0; f < wanted.size(); ++f) {
      if (!wanted[f]) continue;
      const CountedSum found = sum_(look.local, f, places && sink.image->frequency_index == f ? &*places : nullptr);
      s[f] = found.s, all.terms += found.terms, all.work += found.work;
    }
    if (places) std::ranges::move(places->pieces, std::back_inserter(sink.image->pieces));
    return {.s = {std::move(s)}, .work = all.work, .counts = {{.what = count_, .count = all.terms}}};
  }

 private:
  const BandScene& scene_;
  const char* count_;
  const SumAtFrequency sum_;
};

}  // namespace

LookFromAntennas::LookFromAntennas(const BandScene& scene, const Look& look)
    : antennas(antennas_of(scene, look)), local(local_look(scene, look, antennas)) {}

std::optional<StripPlaces> places_in_image(const Look& look, const std::vector<bool>& wanted, const LookSink& sink) {
  if (sink.image == nullptr || !wanted[sink.image->frequency_index]) return std::nullopt;
  StripPlaces places{};
  if (sink.image->by_path) places.by_path = PathPlace{look_vectors(look).scattered};
  return places;
}

std::unique_ptr<Mechanism> beside_waves(const BandScene& scene, const char* count, SumAtFrequency sum) {
  return std::make_unique<SumBesideWaves>(scene, count, std::move(sum));
}

MechanismState state_beside_waves(const SolvePlan& plan, const char* key, bool wanted, const char* what) {
  const MechanismState& waves = plan.state("surface_waves");
  if (!waves.on) return without(fmt::format("there are no waves over curved surfaces: {}", waves.why_not));
  if (!wanted) return without(fmt::format("{} is false", key));
  return {.on = true, .forced = waves.forced, .what = what, .when = "in looks with waves over curved surfaces"};
}

void tell_beside_waves(const SolvePlan&, const Contribution& part, std::size_t frequency, RowEvidence& row) {
  row.surface_waves += part.at(0, frequency);
}

}  // namespace raytube
