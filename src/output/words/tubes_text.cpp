#include "output/words/tubes_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace raytube {

namespace {

std::string followed_text(const TubePaths& tubes) {
  const std::uint64_t all = std::uint64_t{tubes.columns} * tubes.rows;
  if (tubes.stride == 1) return fmt::format("all {} tubes followed", all);
  return fmt::format("{0} of {1} tubes followed, the middle one of every {2} x {2} cells", tubes.followed, all, tubes.stride);
}

std::string bounce_text(std::size_t number, const std::vector<std::uint32_t>& facets) {
  return fmt::format("bounce {}: {} hits on {} of {} facets\n", number,
                     std::accumulate(facets.begin(), facets.end(), std::uint64_t{0}),
                     std::ranges::count_if(facets, [](std::uint32_t hits) { return hits > 0; }), facets.size());
}

std::string ends_text(const TubePaths& tubes) {
  std::array<std::size_t, 5> ended{};
  for (const TubePath& path : tubes.paths) ++ended[static_cast<std::size_t>(path.end)];
  return fmt::format("end: {} left the scene, {} cut at tubes.max_bounces, {} lost, {} absorbed, {} transmitted\n", ended[0],
                     ended[1], ended[2], ended[3], ended[4]);
}

}  // namespace

std::string tubes_text(const TubePaths& tubes, const FacetHits& hits) {
  std::string text = fmt::format("launch grid: {} columns, {} rows; {}\n{} of them meet the target\n", tubes.columns, tubes.rows,
                                 followed_text(tubes), tubes.met_target());
  if (const std::size_t behind = tubes.paths.size() - tubes.met_target(); behind > 0)
    text += fmt::format("{} more paths continue behind sheets\n", behind);
  for (std::size_t i = 0; i < hits.at_bounce.size(); ++i) text += bounce_text(i + 1, hits.at_bounce[i]);
  return text + ends_text(tubes);
}

}  // namespace raytube
