#include "scene/tube_paths.h"

#include <algorithm>
#include <utility>

namespace raytube {

std::vector<std::uint32_t> FacetHits::at_any_bounce() const {
  std::vector<std::uint32_t> sums = at_bounce.front();
  for (std::size_t bounce = 1; bounce < at_bounce.size(); ++bounce)
    std::ranges::transform(sums, at_bounce[bounce], sums.begin(), std::plus{});
  return sums;
}

void add_lit_by_ground(TubePaths& straight, TubePaths by_ground) {
  for (TubePath& path : by_ground.paths) {
    path.lit_by_ground = true;
    straight.paths.push_back(std::move(path));
  }
}

FacetHits facet_hits(const TubePaths& tubes, std::size_t triangles) {
  int most = 1;
  for (const TubePath& path : tubes.paths) most = std::max(most, path.bounces());
  FacetHits hits{std::vector(static_cast<std::size_t>(most), std::vector<std::uint32_t>(triangles, 0))};
  for (const TubePath& path : tubes.paths)
    for (const TubePathPoint& point : path.points)
      if (point.triangle >= 0)
        ++hits.at_bounce[static_cast<std::size_t>(point.bounce - 1)][static_cast<std::size_t>(point.triangle)];
  return hits;
}

}  // namespace raytube
