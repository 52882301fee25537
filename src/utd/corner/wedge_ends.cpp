#include "utd/corner/wedge_ends.h"

namespace raytube {

namespace {

std::vector<dvec3> ends_of(std::span<const Wedge> wedges) {
  std::vector<dvec3> ends;
  for (const Wedge& wedge : wedges) ends.insert(ends.end(), {wedge.start, wedge.end});
  return ends;
}

std::vector<std::uint32_t> ends_that_count(std::span<const Wedge> wedges) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < wedges.size(); ++i)
    if (!wedges[i].flat && wedges[i].replaced_by == no_index) numbers.insert(numbers.end(), {2 * i, 2 * i + 1});
  return numbers;
}

}  // namespace

WedgeEnds::WedgeEnds(std::span<const Wedge> wedges)
    : wedges_(wedges), positions_(ends_of(wedges)), tree_(positions_, ends_that_count(wedges)) {}

dvec3 WedgeEnds::direction(std::uint32_t end) const {
  const Wedge& of = wedge(end);
  return glm::normalize(end % 2 == 0 ? of.end - of.start : of.start - of.end);
}

std::span<const std::uint32_t> WedgeEnds::met_by(std::uint32_t end, double distance) {
  met_.clear();
  tree_.near_segment(positions_[end], positions_[end] + distance * direction(end), distance, met_);
  std::erase(met_, end);
  return met_;
}

}  // namespace raytube
