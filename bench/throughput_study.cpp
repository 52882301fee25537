// Rays per second of the uniform mode, with physical optics of both polarisations in double, against bare Embree on the same
// rays.
#include "bare_embree.h"
#include "bodies.h"
#include "studies.h"
#include "timing.h"
#include "vehicle.h"

namespace raytube::bench {

namespace {

Json measure(const Body& body, int threads, int repeats) {
  const SolveOptions options = uniform(10.0, threads);
  std::vector<double> solver, bare;
  BareTime last;
  std::uint64_t rays = 0;
  on_threads(threads, [&] {
    for (int i = 0; i < repeats; ++i) {
      const Outcome outcome = solved(body, body.sweep, options);
      rays = outcome.rays;
      solver.push_back(outcome.seconds);
      last = bare_embree_time(body.target, body.sweep, options.tubes);
      bare.push_back(last.seconds);
    }
  });
  return {{"body", body.name},         {"triangles", body.target.mesh.triangles.size()},
          {"threads", threads},        {"rays", rays},
          {"bare_rays", last.rays},    {"hit_share", static_cast<double>(last.hits) / static_cast<double>(last.rays)},
          {"solve_s", median(solver)}, {"bare_s", median(bare)}};
}

}  // namespace

Json throughput_study(const Settings& settings) {
  Json json;
  const auto both_thread_counts = [&](const Body& body) {
    for (int threads = 1; threads <= settings.threads; threads *= 2) json.push_back(measure(body, threads, settings.repeats));
  };
  const int looks = settings.quick ? 2 : 6;
  const std::vector<double> sizes = settings.quick ? std::vector<double>{1e4} : std::vector<double>{1e4, 1e5, 1e6};
  for (const double triangles : sizes)
    both_thread_counts({"vehicle", build_mesh(vehicle(triangles), 1.0), looks_round(3e9, looks)});
  both_thread_counts({"sphere", repository_mesh("cases/sphere/case.toml"), looks_round(3e9, looks)});
  both_thread_counts({"dihedral", repository_mesh("cases/dihedral/case.toml"), looks_round(94e9, looks)});
  return json;
}

}  // namespace raytube::bench
