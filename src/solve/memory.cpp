#include "solve/memory.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "core/threads.h"
#include "mesh/features/resolved_wedges.h"
#include "sbr/curved/curved_cells.h"
#include "sbr/launch/launch.h"
#include "sbr/sbr.h"
#include "uncertainty/omissions.h"
#include "utd/corner/corner_waves.h"
#include "utd/interaction/illumination_rounds.h"
#include "utd/interaction/interaction_groups.h"
#include "utd/interaction/reflected_light.h"

namespace raytube {

namespace {

// A look, its directions, its place in the plan and in the collector, and the plan's key of it in a hash table.
constexpr double bytes_per_look = sizeof(Look) + sizeof(LookSource) + 4 * sizeof(std::size_t) + 80 + omissions * sizeof(double);
constexpr double edge_parts = 4;             // first order, higher, between, over curved surfaces
constexpr double outlines_per_wedges = 1.0;  // the outlines of the faces beside them take about as much as the wedges

double bytes_per_row(int bounces, bool keep_parts) {
  const double parts = keep_parts ? bounces + edge_parts : 0.0, model = keep_parts ? 1.0 + omissions : 1.0;
  return (1.0 + model) * sizeof(ChannelErrors) + (1.0 + parts) * sizeof(ScatteringMatrix);
}

std::size_t edge_sets(const SolvePlan& plan) {
  std::set<std::pair<std::size_t, double>> sets;
  for (const double frequency : plan.sweep.frequencies)
    sets.emplace(count_thin(plan.target.thin_plate_edges, frequency), known_details(plan.target.wedges, frequency));
  return sets.size();
}

double edge_set_bytes(const SolvePlan& plan) {
  if (!plan.mechanisms.fringe) return 0.0;
  return static_cast<double>(edge_sets(plan) * plan.target.wedges.size() * sizeof(Wedge)) * (1.0 + outlines_per_wedges);
}

// Solved corners of sheets.
double corner_bytes(const SolvePlan& plan) {
  if (!plan.mechanisms.fringe || plan.edges.order == 1) return 0.0;
  return static_cast<double>(edge_sets(plan) * CornerWaves(plan.target.wedges).bytes());
}

// Which triangles meet at an edge, and the curvatures at corners.
double curved_target_bytes(const SolvePlan& plan) {
  if (!plan.mechanisms.surface_waves) return 0.0;
  const double sides = 3.0 * static_cast<double>(plan.target.mesh.triangles.size());
  return sides * (2.0 * sizeof(EdgeTable::Side) + 3.0 * sizeof(std::uint32_t)) +
         static_cast<double>(plan.wave_surfaces->normals()) * (sizeof(glm::dmat3) + sizeof(double));
}

// The edges and faces of each set as edge-face interaction sees them, and which of them count at each frequency.
double interaction_set_bytes(const SolvePlan& plan) {
  if (!plan.mechanisms.interaction) return 0.0;
  const auto patches = static_cast<double>(plan.target.mesh.patches.size());
  const double parts =
      static_cast<double>(plan.target.wedges.size()) * sizeof(EdgeAxis) + patches * (sizeof(PatchExtent) + sizeof(std::uint32_t));
  const auto frequencies = static_cast<double>(plan.sweep.frequencies.size());
  return static_cast<double>(edge_sets(plan)) * parts + frequencies * (patches / 8 + sizeof(InteractionGroup));
}

double interaction_look_bytes(const SolvePlan& plan) {
  if (!plan.mechanisms.interaction) return 0.0;
  const auto wedges = static_cast<double>(plan.target.wedges.size());
  const double pieces = wedges + 2.0 * most_reflected_pairs;
  return illumination_bytes(plan.sweep.frequencies.size(), pieces * static_cast<double>(plan.target.mesh.patches.size())) +
         wedges * sizeof(LitEdgePiece);
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
    const double range = look.far() ? look.transmit_range
                                    : glm::distance(look.transmit_range * spherical_basis(look.transmit).radial, mesh.center);
    const double nearest = std::max(0.05, 1.0 - mesh.radius / range);
    return static_cast<double>(grid.cells()) * grid.du * grid.dv / (nearest * nearest);
  };
  return *std::ranges::max_element(sweep.looks, {}, area);
}

// Groups of sums that a look may have at a time.
std::size_t most_tiles(const SolvePlan& plan) {
  if (plan.mechanisms.rays) return 1;
  const Target& target = plan.target;
  const Sweep& sweep = plan.sweep;
  const auto tiles = [&](const Look& look) {
    return tiles_of_look(target.tracer, target.faces, look, sweep.frequencies, plan.tubes);
  };
  if (plan.tubes.mode == TubeMode::uniform) return tiles(widest_look(target.mesh, sweep, plan.tubes));
  const std::size_t flat = tiles(sweep.looks.front());
  if (!plan.smooth) return flat;
  return plan.convexity.no_reflection ? std::max(flat, CurvedLook::blocks) : std::numeric_limits<std::size_t>::max();
}

}  // namespace

MemoryEstimate estimate_memory(const SolvePlan& plan) {
  const int bounces = plan.max_bounces();
  const std::size_t frequencies = plan.sweep.frequencies.size();
  const auto rows = static_cast<double>(plan.sweep.rows()), looks = static_cast<double>(plan.sweep.looks.size());
  const auto under_way = std::min<std::size_t>(plan.threads > 0 ? plan.threads : all_threads(), plan.sweep.looks.size());
  const double edge_sums = edge_parts * static_cast<double>(frequencies) * sizeof(ScatteringMatrix);
  return {rows * bytes_per_row(bounces, plan.keep_parts) + looks * bytes_per_look,
          static_cast<double>(under_way) *
              (look_sum_bytes(most_tiles(plan), bounces, frequencies) + edge_sums + interaction_look_bytes(plan)),
          edge_set_bytes(plan) + corner_bytes(plan) + curved_target_bytes(plan) + interaction_set_bytes(plan)};
}

}  // namespace raytube
