// What bare Embree takes for the rays of the uniform grid: what every throughput here is compared with.
#pragma once

#include "solve/solve.h"

namespace raytube::bench {

/// Time of bare rtcIntersect16 for every ray the uniform mode shoots in a sweep (`tubes`: its density, bounces and axes), in the
/// same order, on the threads of the calling arena.
struct BareTime {
  double seconds = 0.0;
  std::uint64_t rays = 0, hits = 0;
};
BareTime bare_embree_time(const Target& target, const Sweep& sweep, const TubeOptions& tubes);

}  // namespace raytube::bench
