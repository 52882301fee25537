#include "utd/crossings.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

constexpr double parallel = 1e-12;  // sine between two edges that never cross

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

// Any two axes across the direction.
std::array<dvec3, 2> axes_across(const dvec3& direction) {
  const dvec3 helper = std::abs(direction.z) < 0.6 ? dvec3(0, 0, 1) : dvec3(1, 0, 0);
  const dvec3 first = glm::normalize(glm::cross(helper, direction));
  return {first, glm::cross(direction, first)};
}

}  // namespace

Crossings::Crossings(std::span<const Wedge> wedges, const dvec3& direction) {
  const auto [u, v] = axes_across(direction);
  const auto flat = [&](const dvec3& p) { return dvec2(glm::dot(p, u), glm::dot(p, v)); };
  dvec2 high(-1e300);
  low_ = dvec2(1e300);
  for (const Wedge& wedge : wedges) {
    segments_.push_back({flat(wedge.start), flat(wedge.end), glm::dot(wedge.start, direction), glm::dot(wedge.end, direction)});
    for (const dvec2& point : {segments_.back().start, segments_.back().end}) {
      low_ = glm::min(low_, point);
      high = glm::max(high, point);
    }
  }
  cells_ = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(wedges.size() + 1))));
  cell_size_ = glm::max((high - low_) / static_cast<double>(cells_), dvec2(1e-300));
  grid_.resize(cells_ * cells_);
  for (std::uint32_t i = 0; i < segments_.size(); ++i)
    visit_cells(segments_[i], [&](std::size_t index) { grid_[index].push_back(i); });
}

std::size_t Crossings::cell(const dvec2& point, int axis) const {
  const double place = (point[axis] - low_[axis]) / cell_size_[axis];
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(cells_ - 1)));
}

/// Column after column, the rows that the segment passes in it and one more on either side, against rounding.
template <class Visit>
void Crossings::visit_cells(const Segment& segment, Visit visit) const {
  const dvec2 along = segment.end - segment.start;
  const auto [first, last] = std::minmax({cell(segment.start, 0), cell(segment.end, 0)});
  for (std::size_t column = first; column <= last; ++column) {
    double from = 0.0, to = 1.0;
    if (first != last) {
      const double left = low_.x + cell_size_.x * static_cast<double>(column);
      const double at_left = (left - segment.start.x) / along.x, at_right = at_left + cell_size_.x / along.x;
      from = std::clamp(std::min(at_left, at_right), 0.0, 1.0);
      to = std::clamp(std::max(at_left, at_right), 0.0, 1.0);
    }
    const auto [bottom, top] = std::minmax({cell(segment.start + from * along, 1), cell(segment.start + to * along, 1)});
    for (std::size_t row = bottom > 0 ? bottom - 1 : 0; row <= std::min(top + 1, cells_ - 1); ++row) visit(row * cells_ + column);
  }
}

void Crossings::find(std::uint32_t index, std::vector<double>& places) const {
  places.clear();
  const Segment& own = segments_[index];
  const dvec2 along = own.end - own.start;
  visit_cells(own, [&](std::size_t cell_index) {
    for (const std::uint32_t i : grid_[cell_index]) {
      const Segment& other = segments_[i];
      const dvec2 across = other.end - other.start, offset = other.start - own.start;
      const double area = cross(along, across);
      if (std::abs(area) <= parallel * glm::length(along) * glm::length(across)) continue;
      const double here = cross(offset, across) / area, there = cross(offset, along) / area;
      if (here <= 0.0 || here >= 1.0 || there < 0.0 || there > 1.0) continue;
      const double own_depth = own.start_depth + here * (own.end_depth - own.start_depth);
      if (other.start_depth + there * (other.end_depth - other.start_depth) > own_depth) places.push_back(here);
    }
  });
  std::ranges::sort(places);
}

}  // namespace raytube
