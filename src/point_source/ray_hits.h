// Rays of any launch bouncing through a scene, and what they hit: specular reflection, absorbers, counts for every part.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "mesh/model/join.h"
#include "point_source/launch_model.h"
#include "point_source/source_study.h"

namespace raytube {

struct HitOptions {
  int max_reflections = 10;  // the hit after the last one still counts
  std::size_t counted = 0;   // the part whose hits are kept
  bool keep_hits = false;
  int threads = 1;
  std::function<bool(double)> progress;  // share done; returns false to stop
};

/// Counts of one launch; `hits`, where kept, are those of the counted part in a fixed order, in recentred coordinates.
struct RayHits {
  std::vector<PartHits> parts;  // without limits and exact shares
  std::uint64_t escaped = 0, absorbed = 0, cut = 0, missed = 0;
  std::vector<CountedHit> hits;
};

/// Traces all rays of a launch. The counts and sums do not depend on the number of threads. Throws Interrupted when progress says
/// stop. The estimate of a part is the sum of the weights of the rays that meet it first; a ray aimed at a triangle that meets
/// another one first has no weight, because that direction is another ray's; for LaunchModel::random its bound is four standard
/// deviations, from the sample.
RayHits trace_rays(const Tracer& tracer, std::span<const std::uint32_t> triangle_part, std::span<const RaySurface> surfaces,
                   const Launch& launch, const HitOptions& options);

}  // namespace raytube
