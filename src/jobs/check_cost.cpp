#include "jobs/check_cost.h"

#include <algorithm>

#include "jobs/memory.h"
#include "sbr/launch/launch.h"
#include "sbr/sbr.h"

namespace raytube {

namespace {

LaunchGrid grid_of(const SolvePlan& plan, std::size_t look) {
  return grid_of_look(plan.target.mesh, plan.sweep.looks[look], plan.shortest_wavelength(), plan.tubes.per_wavelength,
                      plan.tubes.up);
}

void tell_clipped_cost(CheckReport& report, const SolvePlan& plan) {
  report.print(
      "\ncost\n  looks computed: {}\n  adaptive tubes, clipped: {} planar patches; the fewer, the quicker, at any frequency\n",
      plan.looks.computed.size(), plan.target.mesh.patches.size());
}

void tell_rays(CheckReport& report, const SolvePlan& plan) {
  report.print("\nrays instead of currents (edges.method \"utd\")\n");
  if (plan.ray_range > 0.0)
    report.print("  transmitter and receiver {:.6g} m from the origin; amplitudes are apparent ones at that range\n",
                 plan.ray_range);
  report.print("  looks computed: {}; {} planar patches as mirrors, {} wedges\n", plan.looks.computed.size(),
               plan.target.mesh.patches.size(), plan.target.wedges.size());
}

void tell_grid_cost(CheckReport& report, const SolvePlan& plan) {
  const LaunchGrid first = grid_of(plan, 0);
  report.print("\ncost\n  first look: {} x {} tubes of {:.4g} mm x {:.4g} mm{}\n  looks computed: {}\n", first.columns,
               first.rows, first.du * 1e3, first.dv * 1e3,
               plan.tubes.mode == TubeMode::adaptive ? "; adaptive tubes are mostly far fewer" : "", plan.looks.computed.size());
}

}  // namespace

void tell_cost(CheckReport& report, const SolvePlan& plan) {
  report.data["looks_computed"] = plan.looks.computed.size();
  if (plan.rays())
    tell_rays(report, plan);
  else if (plan.tubes.refines())
    tell_clipped_cost(report, plan);
  else
    tell_grid_cost(report, plan);
}

void tell_memory(CheckReport& report, const SolvePlan& plan, const Case& c) {
  SolvePlan with_parts = plan;
  with_parts.keep_parts = true;
  report.data["memory_bytes"] = memory_of_run(plan, c, nullptr);
  report.print("\nmemory\n  at most about {}, {} with --parts, however dense the tubes are; {} available\n",
               memory_text(memory_of_run(plan, c, nullptr)), memory_text(memory_of_run(with_parts, c, nullptr)),
               memory_text(memory_to_be_had()));
  if (std::ranges::any_of(c.sweep.materials, &Material::transmits))
    report.print("  and about {} where sheets double the number of tubes up to its limit; more where many stand in a row\n",
                 memory_text(plan.threads * tubes_between_sheets_bytes(c.sweep.frequencies.size())));
}

}  // namespace raytube
