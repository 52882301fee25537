#include "solve/memory.h"

#include <algorithm>
#include <limits>

#include "core/threads.h"
#include "sbr/curved/curved_cells.h"
#include "sbr/launch/launch.h"
#include "sbr/sbr.h"
#include "uncertainty/omissions.h"

namespace raytube {

namespace {

// A look, its directions, its place in the plan and in the collector, and the plan's key of it in a hash table.
constexpr double bytes_per_look = sizeof(Look) + sizeof(LookSource) + 4 * sizeof(std::size_t) + 80 + omissions * sizeof(double);

double bytes_per_row(const SolvePlan& plan) {
  const double parts = plan.keep_parts ? static_cast<double>(plan.columns()) : 0.0,
               model = plan.keep_parts ? 1.0 + omissions : 1.0;
  return (1.0 + model) * sizeof(ChannelErrors) + (1.0 + parts) * sizeof(ScatteringMatrix);
}

// What the mechanisms that take part hold: for all looks, or for each look under way.
double mechanism_bytes(const SolvePlan& plan, double (*MechanismEntry::*bytes)(const SolvePlan&)) {
  double sum = 0.0;
  for (std::size_t i = 0; i < plan.mechanisms.size(); ++i)
    if (plan.mechanisms[i].*bytes && plan.states[i].on) sum += (plan.mechanisms[i].*bytes)(plan);
  return sum;
}

// In which the launch grid has the most cells, by the box round the target: quicker than by all of its vertices. From nearby the
// box looks larger.
const Look& widest_look(const TriangleMesh& mesh, const Sweep& sweep, const TubeOptions& tubes) {
  TriangleMesh box;
  box.center = mesh.center, box.radius = mesh.radius;
  const Box bounds = bounding_box(mesh.vertices);
  for (const int corner : {0, 1, 2, 3, 4, 5, 6, 7})
    box.vertices.push_back({(corner & 1 ? bounds.high : bounds.low).x, (corner & 2 ? bounds.high : bounds.low).y,
                            (corner & 4 ? bounds.high : bounds.low).z});
  const auto area = [&](const Look& look) {
    const LaunchGrid grid = launch_grid(box, look.transmit, mesh.radius, 1000.0, tubes.up);
    const double range = look.far() ? look.transmit_range : glm::distance(look.transmitter().point(), mesh.center);
    const double nearest = std::max(0.05, 1.0 - mesh.radius / range);
    return static_cast<double>(grid.cells()) * grid.du * grid.dv / (nearest * nearest);
  };
  return *std::ranges::max_element(sweep.looks, {}, area);
}

bool has_sheets(const SolvePlan& plan) { return std::ranges::any_of(plan.sweep.materials, &Material::transmits); }

// Of the sums that are kept for refinement.
double refined_bytes(const SolvePlan& plan) {
  if (plan.rays() || !plan.tubes.refines()) return 0.0;
  const Target& target = plan.target;
  const std::size_t tiles =
      tiles_of_look(target.tracer, target.faces, plan.sweep.looks.front(), plan.sweep.frequencies, plan.tubes, has_sheets(plan));
  std::size_t frequencies = 0;  // bands are solved one after the other
  for (const BandPlan& band : plan.bands) frequencies = std::max(frequencies, band.frequencies.size());
  return block_sum_bytes(tiles, plan.max_bounces(), frequencies);
}

// Groups of sums that a look may have at a time.
std::size_t most_tiles(const SolvePlan& plan) {
  if (plan.rays()) return 1;
  const Target& target = plan.target;
  const Sweep& sweep = plan.sweep;
  const auto tiles = [&](const Look& look) {
    return tiles_of_look(target.tracer, target.faces, look, sweep.frequencies, plan.tubes, has_sheets(plan));
  };
  if (plan.tubes.mode == TubeMode::uniform) return tiles(widest_look(target.mesh, sweep, plan.tubes));
  const std::size_t flat = tiles(sweep.looks.front());
  const auto is_flat = [](const BandPlan& band) { return band.smooth == nullptr; };
  if (std::ranges::all_of(plan.bands, is_flat)) return flat;
  return plan.no_reflection() ? std::max(flat, CurvedLook::blocks) : std::numeric_limits<std::size_t>::max();
}

}  // namespace

MemoryEstimate estimate_memory(const SolvePlan& plan) {
  const int bounces = plan.max_bounces();
  const std::size_t frequencies = plan.sweep.frequencies.size();
  const auto rows = static_cast<double>(plan.sweep.rows()), looks = static_cast<double>(plan.sweep.looks.size());
  const auto under_way = std::min<std::size_t>(plan.threads > 0 ? plan.threads : all_threads(), plan.sweep.looks.size());
  const double edge_sums =
      static_cast<double>((plan.columns() - static_cast<std::size_t>(bounces)) * frequencies * sizeof(ScatteringMatrix));
  return {rows * bytes_per_row(plan) + looks * bytes_per_look,
          static_cast<double>(under_way) * (look_sum_bytes(most_tiles(plan), bounces, frequencies) + refined_bytes(plan) +
                                            edge_sums + mechanism_bytes(plan, &MechanismEntry::look_bytes)),
          mechanism_bytes(plan, &MechanismEntry::bytes)};
}

}  // namespace raytube
