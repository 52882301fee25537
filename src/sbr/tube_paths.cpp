#include "sbr/tube_paths.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace raytube {

namespace {

constexpr double far_out = 1.25;  // paths that leave the scene end so many radii of the target from its middle

// The launch grid in blocks of `stride` columns and rows, fewer at its upper ends.
struct Blocks {
  const LaunchGrid& grid;
  std::uint32_t stride;

  std::uint64_t across() const { return (grid.columns + std::uint64_t{stride} - 1) / stride; }
  std::uint64_t count() const { return across() * ((grid.rows + std::uint64_t{stride} - 1) / stride); }

  // What a block takes of a side with so many cells: the first one and how many.
  std::pair<std::uint32_t, std::uint32_t> span(std::uint64_t block, std::uint32_t cells) const {
    const std::uint32_t first = static_cast<std::uint32_t>(block) * stride;
    return {first, std::min(stride, cells - first)};
  }
};

std::uint32_t stride_for(const LaunchGrid& grid, std::uint64_t most) {
  const double at_least = std::sqrt(static_cast<double>(grid.cells()) / static_cast<double>(most));
  std::uint32_t stride = std::max(1u, static_cast<std::uint32_t>(at_least));
  while (Blocks{grid, stride}.count() > most) ++stride;
  return stride;
}

double way_out(const dvec3& point, const dvec3& direction, double radius) {
  const double along = glm::dot(point, direction);
  return -along + std::sqrt(along * along + radius * radius - glm::dot(point, point));
}

void add_end(TubePath& path, const TubeTrace& trace, const TriangleMesh& mesh) {
  if (trace.ended == TubeEnd::absorbed || trace.ended == TubeEnd::transmitted) return;
  TubePathPoint point = path.points.back();
  const dvec3 direction = trace.bounces.empty() ? trace.direction : trace.bounces.back().direction_out;
  const double leg = trace.ended == TubeEnd::left_the_scene
                         ? way_out(point.position - mesh.center, direction, far_out * mesh.radius)
                         : trace.last_leg;
  point.position += leg * direction;
  point.path_length += leg;
  point.triangle = -1;
  path.points.push_back(point);
}

// `start` without its position.
TubePath path_of(const TubeTrace& trace, const TriangleMesh& mesh, double area, TubePathPoint start) {
  start.position = trace.start + mesh.center;
  TubePath path{trace.column, trace.row, area, trace.ended, {start}};
  for (const TubeBounce& bounce : trace.bounces) {
    const TubePathPoint& last = path.points.back();
    const dvec3 position = bounce.point + mesh.center;
    path.points.push_back(
        {position, last.bounce + 1, last.path_length + glm::distance(last.position, position), bounce.power, bounce.triangle});
  }
  add_end(path, trace, mesh);
  return path;
}

std::vector<TubePath> paths_of(const std::vector<TubeTrace>& ways, const TriangleMesh& mesh, double area) {
  std::vector<TubePath> paths;
  for (const TubeTrace& way : ways) {
    const auto& [from, met, field, power] = way.parting;
    TubePathPoint start{};
    if (met > 0) {
      const auto sheet = static_cast<std::size_t>(met - ways[from].parting.met);
      start = {{}, met, paths[from].points[sheet].path_length, power};
    }
    paths.push_back(path_of(way, mesh, area, start));
  }
  return paths;
}

bool meets_nothing(const TubeTrace& trace) { return trace.bounces.empty() && trace.ended == TubeEnd::left_the_scene; }

}  // namespace

TubePaths tube_paths(const ReplayScene& scene, const Look& look, double frequency_hz, const TubeOptions& options,
                     std::uint64_t most) {
  const TubeReplay replay(scene, look, frequency_hz, options);
  const LaunchGrid& grid = replay.grid();
  const Blocks blocks{grid, stride_for(grid, most)};
  std::vector<std::vector<TubePath>> found(blocks.count());
  tbb::parallel_for(std::uint64_t{0}, blocks.count(), [&](std::uint64_t i) {
    const auto [column, columns] = blocks.span(i % blocks.across(), grid.columns);
    const auto [row, rows] = blocks.span(i / blocks.across(), grid.rows);
    const std::vector<TubeTrace> ways = replay.follow(column + columns / 2, row + rows / 2);
    if (!meets_nothing(ways.front())) found[i] = paths_of(ways, scene.tracer.mesh(), columns * grid.du * (rows * grid.dv));
  });
  std::vector<TubePath> all;
  for (std::vector<TubePath>& paths : found) std::ranges::move(paths, std::back_inserter(all));
  return {grid.columns, grid.rows, blocks.stride, blocks.count(), std::move(all)};
}

}  // namespace raytube
