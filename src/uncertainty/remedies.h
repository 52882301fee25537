// What would make a part of the model uncertainty less, what that costs, and whether it is worth naming.
#pragma once

#include <string>
#include <vector>

#include "scene/options.h"
#include "scene/results.h"
#include "uncertainty/omissions.h"

namespace raytube {

/// What a solve was asked for, and what it has shown once it is done.
struct RemedyEvidence {
  const EdgeOptions& edges;
  const TubeOptions& tubes;
  const SurfaceOptions& surfaces;
  const TruncatedSums& truncated;
  const std::vector<std::uint64_t>& hits;  // tubes that met a surface, by bounce
  bool materials = false;                  // other than perfect conductors
  bool sheets = false;                     // some of them let waves through
  double curved_edges = 0.0;               // of the length of weak edges: beside curved faces
  double possible_pairs = 0.0;             // of an edge and a face of the target
  std::uint64_t pairs_left_out = 0;        // of an edge and a face or a mirror: for the sake of the budget of interaction
  std::uint64_t interaction_pairs = 0;     // of an edge and a face, that were computed
  double interaction_left_out = 0.0;       // of the squares of what is missing of edge-face interaction: for its budget's sake
  std::uint64_t looks_without_waves = 0;   // over curved surfaces, which were too weak there
};

/// A key of the case and about how much longer the run will take, or "none ...". The key that switched off what the part lacks
/// comes first; others are named only where they make the part less by a noticeable share, for at most ten times the time.
std::string remedy_of(Omission omission, const RemedyEvidence& evidence);

}  // namespace raytube
