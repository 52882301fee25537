// What the mechanisms of a band share.
#pragma once

#include <optional>

#include "plan/plan.h"
#include "sbr/sbr.h"
#include "uncertainty/target_features.h"
#include "utd/edge_sets.h"
#include "utd/tip/tips.h"

namespace raytube {

/// A target at the frequencies of one band. Refers to the plan, and to what of its target is curved.
struct BandScene {
  BandScene(const SolvePlan& plan, const BandPlan& band, const CurvedParts& curved_parts);
  BandScene(const BandScene&) = delete;

  const SolvePlan& plan;
  const BandPlan& band;
  const CurvedParts& curved_parts;
  std::vector<Material> materials;     // of the sweep, at the band's frequencies
  TubeScene tubes;                     // what tubes meet
  std::optional<CurvedTarget> curved;  // if waves run over surfaces
  std::vector<Tip> round_tips;         // of these, if wanted
  EdgeSets edges;                      // at the band's frequencies
};

}  // namespace raytube
