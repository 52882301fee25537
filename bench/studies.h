// The studies of the report: each solves what it needs, side by side, and gives plain numbers as JSON. The report is made of them
// by bench/run.
#pragma once

#include <nlohmann/json.hpp>

#include "solve/solve.h"

namespace raytube::bench {

using Json = nlohmann::ordered_json;

struct Settings {
  bool quick = false;
  int threads = 2;
  int repeats = 5;  // of which the median time is taken
};

/// Error against rays and time: uniform grid, adaptive tubes, the same with exact outlines, rays at random.
Json error_study(const Settings& settings);
/// Uniform mode against bare Embree on the same rays.
Json throughput_study(const Settings& settings);
/// Time against frequency, triangles, looks, number of frequencies, threads.
Json growth_study(const Settings& settings);
/// Adaptive against uniform tubes on the dihedral, and the jobs of the cases against bare Embree on the uniform grid.
Json job_study(const Settings& settings);

}  // namespace raytube::bench
