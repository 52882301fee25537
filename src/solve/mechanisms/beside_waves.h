// What waves over curved surfaces share with the mechanisms that run in their rows: rounded edges, flat tips and round tips.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "scene/antenna.h"
#include "solve/mechanisms/band_scene.h"
#include "solve/mechanisms/mechanism.h"
#include "utd/surface/local_look.h"
#include "utd/surface/strip_sum.h"

namespace raytube {

/// A look and the antennas to which it refers if they are at a finite distance.
struct LookFromAntennas {
  LookFromAntennas(const BandScene& scene, const Look& look);
  LookFromAntennas(const LookFromAntennas&) = delete;

  std::optional<AntennaPair> antennas;
  LocalLook local;
};

/// Places of pieces, if an image at a wanted frequency asks for them.
std::optional<StripPlaces> places_in_image(const Look& look, const std::vector<bool>& wanted, const LookSink& sink);

/// S at one frequency of the band, by its index.
using SumAtFrequency = std::function<CountedSum(LocalLook&, std::size_t frequency, StripPlaces*)>;

/// A mechanism in the rows of these waves that sums at one frequency after the other; `count` is the name of its terms.
std::unique_ptr<Mechanism> beside_waves(const BandScene& scene, const char* count, SumAtFrequency sum);

/// Its state: that of the waves, unless its own key is false.
MechanismState state_beside_waves(const SolvePlan& plan, const char* key, bool wanted, const char* what);

/// All of them are evidence of one kind.
void tell_beside_waves(const SolvePlan& plan, const Contribution& part, std::size_t frequency, RowEvidence& row);

/// No current on a curved surface is stronger than on a plane.
inline double bound_on_curved_surfaces(const AmplitudeLimits& limits) { return limits.surface; }

}  // namespace raytube
