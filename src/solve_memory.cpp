#include "solve_memory.h"

#include <algorithm>
#include <set>

#include "threads.h"

namespace raytube {

namespace {

// A look, its directions, its place in the plan and in the collector, and the plan's key of it in a hash table.
constexpr double bytes_per_look = sizeof(Look) + sizeof(LookSource) + 4 * sizeof(std::size_t) + 80;
constexpr double edge_parts = 3;             // first order, higher, between
constexpr double outlines_per_wedges = 1.0;  // the outlines of the faces beside them take about as much as the wedges

int most_bounces(const Target& target, const TubeOptions& tubes) {
  return target.convexity.no_reflection ? 1 : tubes.max_bounces;
}

double bytes_per_row(int bounces, bool keep_parts) {
  const double parts = keep_parts ? bounces + edge_parts : 0.0;
  return sizeof(ChannelErrors) + (1.0 + parts) * sizeof(ScatteringMatrix);
}

double edge_set_bytes(const Target& target, const Sweep& sweep, const EdgeOptions& edges) {
  if (edges.method != EdgeMethod::fringe) return 0.0;
  std::set<std::size_t> sets;
  for (const double frequency : sweep.frequencies) sets.insert(thin_rims(target.rims, frequency));
  return static_cast<double>(sets.size() * target.wedges.size() * sizeof(Wedge)) * (1.0 + outlines_per_wedges);
}

}  // namespace

MemoryEstimate estimate_memory(const Target& target, const Sweep& sweep, const SolveOptions& options) {
  const int bounces = most_bounces(target, options.tubes);
  const auto rows = static_cast<double>(sweep.rows()), looks = static_cast<double>(sweep.looks.size());
  const auto under_way = std::min<std::size_t>(options.threads > 0 ? options.threads : all_threads(), sweep.looks.size());
  const std::size_t tiles = tiles_of_look(target.tracer, target.faces, sweep.looks.front(), sweep.frequencies, options.tubes);
  const double edge_sums = edge_parts * static_cast<double>(sweep.frequencies.size()) * sizeof(ScatteringMatrix);
  return {rows * bytes_per_row(bounces, options.keep_parts) + looks * bytes_per_look,
          static_cast<double>(under_way) * (look_sum_bytes(tiles, bounces, sweep.frequencies.size()) + edge_sums),
          edge_set_bytes(target, sweep, options.edges)};
}

}  // namespace raytube
