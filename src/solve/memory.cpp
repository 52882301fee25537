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

// Groups of sums that a look has at a time.
std::size_t tiles(const SolvePlan& plan, const Look& look) {
  const Target& target = plan.target;
  return tiles_of_look(target.tracer, target.faces, look, plan.sweep.frequencies, plan.tubes, plan.sweep.materials);
}

// The most that any look may have.
std::size_t most_tiles(const SolvePlan& plan) {
  if (plan.rays()) return 1;
  if (plan.tubes.mode == TubeMode::uniform) return tiles(plan, widest_look(plan.target.mesh, plan.sweep, plan.tubes));
  const std::size_t flat = tiles(plan, plan.sweep.looks.front());
  const auto is_flat = [](const BandPlan& band) { return band.smooth == nullptr; };
  if (std::ranges::all_of(plan.bands, is_flat)) return flat;
  return plan.no_reflection() ? std::max(flat, CurvedLook::blocks) : std::numeric_limits<std::size_t>::max();
}

// Bands are solved one after the other.
double refined_bytes(const SolvePlan& plan) {
  if (plan.rays() || !plan.tubes.refines()) return 0.0;
  std::size_t frequencies = 0;
  for (const BandPlan& band : plan.bands) frequencies = std::max(frequencies, band.frequencies.size());
  return block_sum_bytes(tiles(plan, plan.sweep.looks.front()), plan.max_bounces(), frequencies);
}

}  // namespace

std::vector<MemoryPart> estimate_memory(const SolvePlan& plan) {
  const int bounces = plan.max_bounces();
  const std::size_t frequencies = plan.sweep.frequencies.size(), columns = plan.columns() - static_cast<std::size_t>(bounces);
  const auto rows = static_cast<double>(plan.sweep.rows()), looks = static_cast<double>(plan.sweep.looks.size());
  const double under_way = std::min(static_cast<double>(plan.threads > 0 ? plan.threads : all_threads()), looks);
  std::vector<MemoryPart> parts{
      {"rows", MemoryOf::rows, rows * bytes_per_row(plan)},
      {"looks of the sweep", MemoryOf::rows, looks * bytes_per_look},
      {"sums of tubes", MemoryOf::looks, under_way * look_sum_bytes(most_tiles(plan), bounces, frequencies)},
      {"sums of tubes that are refined", MemoryOf::looks, under_way * refined_bytes(plan)},
      {"sums of mechanisms", MemoryOf::looks, under_way * static_cast<double>(columns * frequencies * sizeof(ScatteringMatrix))}};
  for (std::size_t i = 0; i < plan.mechanisms.size(); ++i) {
    const MechanismEntry& mechanism = plan.mechanisms[i];
    if (!plan.states[i].on) continue;
    if (mechanism.bytes) parts.push_back({mechanism.label, MemoryOf::program, mechanism.bytes(plan)});
    if (mechanism.look_bytes) parts.push_back({mechanism.label, MemoryOf::looks, under_way * mechanism.look_bytes(plan)});
  }
  return parts;
}

double bytes_of(const std::vector<MemoryPart>& parts, MemoryOf of) {
  double sum = 0.0;
  for (const MemoryPart& part : parts)
    if (part.of == of) sum += part.bytes;
  return sum;
}

}  // namespace raytube
