#include "utd/corner/corner_waves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "solve/mechanisms/band_scene.h"
#include "solve/mechanisms/list.h"
#include "uncertainty/omissions.h"

namespace raytube {

namespace {

/// What tells the kinds of edges apart from corner to corner of which waves run.
struct KindOfCornerWaves {
  const char *name, *label, *key;
  bool CornerWaveOptions::*wanted;
  MechanismColumn column;
  const char* none;  // in words
};

// No wave along an edge is stronger than the current at the edge.
double bound_of_corner_waves(const AmplitudeLimits& limits) { return (limits.edge_order - 1) * limits.edges; }

template <CornerWaveKind kind>
const KindOfCornerWaves& kind_of_waves() {
  static const std::array<KindOfCornerWaves, 3> all{
      {{"plate_corners",
        "corner waves of plates",
        "edges.plate_corners",
        &CornerWaveOptions::plates,
        {"plate_corners", "corner waves of plates (edges.plate_corners)", bound_of_corner_waves},
        "no edge of a plate runs between two corners"},
       {"thin_ends",
        "corner waves of thin ends",
        "edges.thin_ends",
        &CornerWaveOptions::thin_ends,
        {"thin_ends", "corner waves of thin ends (edges.thin_ends)", bound_of_corner_waves},
        "the target has no end of a thin body"},
       {"solid_corners",
        "corner waves of solids",
        "edges.solid_corners",
        &CornerWaveOptions::solids,
        {"solid_corners", "corner waves of solids (edges.solid_corners)", bound_of_corner_waves},
        "no edge of a solid runs between two corners of three faces"}}};
  return all[static_cast<std::size_t>(kind)];
}

template <CornerWaveKind kind>
class CornerWavesOfLook : public Mechanism {
 public:
  explicit CornerWavesOfLook(const BandScene& scene) : scene_(scene) {}

  // Corners of solids take long to solve.
  Prospect prospect(const TracedLook& traced) const override {
    if (kind != CornerWaveKind::solid) return {};
    return {.amplitude = scene_.edges.solid_corner_amplitudes(traced.look, scene_.plan.sweep.radar)};
  }

  Contribution solve(const TracedLook& traced, const std::vector<bool>& wanted, LookSink& sink) const override {
    const Radar& radar = scene_.plan.sweep.radar;
    if (sink.image) {
      if (!wanted[sink.image->frequency_index]) return {};
      const PieceRequest request{sink.image->frequency_index, sink.image->lattice, sink.image->by_path};
      std::ranges::move(scene_.edges.corner_wave_pieces(traced.look, radar, request, kind),
                        std::back_inserter(sink.image->pieces));
      return {};
    }
    CornerWaveSum found = scene_.edges.corner_waves(traced.look, radar, kind);
    for (std::size_t f = 0; f < wanted.size(); ++f)
      if (!wanted[f]) found.scattering[f] = {};
    return {.s = {std::move(found.scattering)},
            .work = found.work,
            .counts = {{.what = kind_of_waves<kind>().name, .count = found.edges, .fold = Fold::most}}};
  }

 private:
  const BandScene& scene_;
};

template <CornerWaveKind kind>
MechanismState state_of_corner_waves(const SolvePlan& plan) {
  if (!plan.fringe()) return without(edge_currents_state(plan).why_not);
  if (!(plan.edges.corners.*kind_of_waves<kind>().wanted)) return without(fmt::format("{} is false", kind_of_waves<kind>().key));
  if (plan.edges.order == 1) return without("edges.order is 1");
  if (std::ranges::none_of(plan.corner_waves, [](const auto& waves) { return waves->count(kind) > 0; }))
    return without(kind_of_waves<kind>().none);
  if (kind != CornerWaveKind::solid) return {.on = true, .forced = true, .what = "from corner to corner"};
  return {.on = true, .what = "from corner to corner", .when = "in looks where they can change a row by accuracy.tolerance_db"};
}

template <CornerWaveKind kind>
std::unique_ptr<Mechanism> make_corner_waves(const BandScene& scene) {
  if (!scene.plan.fringe() || !scene.edges.has_corner_waves(kind)) return nullptr;
  return std::make_unique<CornerWavesOfLook<kind>>(scene);
}

// Evidence of what edges of a second order add.
void tell_corner_waves(const SolvePlan&, const Contribution& waves, std::size_t frequency, RowEvidence& row) {
  row.higher += waves.at(0, frequency);
}

// The solved corners.
template <CornerWaveKind kind>
double bytes_of_corner_waves(const SolvePlan& plan) {
  double bytes = 0.0;
  for (const auto& waves : plan.corner_waves) bytes += static_cast<double>(waves->bytes(kind));
  return bytes;
}

template <CornerWaveKind kind>
MechanismEntry corner_waves_entry() {
  const KindOfCornerWaves& of = kind_of_waves<kind>();
  return {.name = of.name,
          .label = of.label,
          .key = of.key,
          .budget_key = nullptr,
          .columns = {of.column},
          .counts = {of.name},
          .state = state_of_corner_waves<kind>,
          .make = make_corner_waves<kind>,
          .bytes = bytes_of_corner_waves<kind>,
          .tell = tell_corner_waves};
}

}  // namespace

MechanismEntry plate_corners_entry() { return corner_waves_entry<CornerWaveKind::plate>(); }
MechanismEntry thin_ends_entry() { return corner_waves_entry<CornerWaveKind::thin_end>(); }
MechanismEntry solid_corners_entry() { return corner_waves_entry<CornerWaveKind::solid>(); }

}  // namespace raytube
