#include "utd/shadow/crossings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "utd/wedge/rounding_guard.h"

namespace raytube {

namespace {

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

// Any two axes across the direction.
std::array<dvec3, 2> axes_across(const dvec3& direction) {
  const dvec3 helper = std::abs(direction.z) < 0.6 ? dvec3(0, 0, 1) : dvec3(1, 0, 0);
  const dvec3 first = glm::normalize(glm::cross(helper, direction));
  return {first, glm::cross(direction, first)};
}

// A line grazes a wedge if it runs through free space on both sides of the edge: if one of the faces is turned towards it and the
// other one away. A shadow never ends at a concave edge. A direction within 1e-3 of a face's plane may lie
// on either side of it.
bool on_silhouette(const Wedge& wedge, const dvec3& direction) {
  const double first = glm::dot(wedge.faces[0].normal, direction), second = glm::dot(wedge.faces[1].normal, direction);
  return wedge.convex() && std::min(first, second) < 1e-3 && std::max(first, second) > -1e-3;
}

}  // namespace

Crossings::Crossings(std::span<const Wedge> wedges, const dvec3& direction) {
  const auto [u, v] = axes_across(direction);
  const auto flat = [&across = u, &along = v](const dvec3& p) { return dvec2(glm::dot(p, across), glm::dot(p, along)); };
  dvec2 high(-1e300);
  low_ = dvec2(1e300);
  std::vector<std::uint32_t> silhouette;
  for (const Wedge& wedge : wedges) {
    const dvec2 start = flat(wedge.start), end = flat(wedge.end);
    const double depth = glm::dot(wedge.start, direction);
    if (on_silhouette(wedge, direction)) silhouette.push_back(static_cast<std::uint32_t>(segments_.size()));
    segments_.push_back({start, end - start, glm::length(end - start), depth, glm::dot(wedge.end, direction) - depth});
    low_ = glm::min(low_, glm::min(start, end));
    high = glm::max(high, glm::max(start, end));
  }
  cells_ = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(wedges.size() + 1))));
  cell_size_ = glm::max((high - low_) / static_cast<double>(cells_), dvec2(1e-300));
  fill_grid(silhouette);
}

// One row more on either side, against rounding.
void Crossings::fill_grid(std::span<const std::uint32_t> silhouette) {
  std::vector<std::pair<std::size_t, std::uint32_t>> entries;
  for (const std::uint32_t i : silhouette)
    visit_cells(segments_[i], 1, [&](std::size_t index) { entries.emplace_back(index, i); });
  first_.assign(cells_ * cells_ + 1, 0);
  for (const auto& entry : entries) ++first_[entry.first + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  inside_.resize(entries.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const auto& [index, segment] : entries) inside_[next[index]++] = segment;
}

std::size_t Crossings::cell(const dvec2& point, int axis) const {
  const double cells = (point[axis] - low_[axis]) / cell_size_[axis];
  return static_cast<std::size_t>(std::clamp(cells, 0.0, static_cast<double>(cells_ - 1)));
}

// Column after column, the rows that the segment passes in it and `margin` more on either side.
template <class Visit>
void Crossings::visit_cells(const Segment& segment, std::size_t margin, Visit visit) const {
  const dvec2 along = segment.along;
  const auto [first, last] = std::minmax({cell(segment.start, 0), cell(segment.start + along, 0)});
  for (std::size_t column = first; column <= last; ++column) {
    double from = 0.0, to = 1.0;
    if (first != last) {
      const double left = low_.x + cell_size_.x * static_cast<double>(column);
      const double at_left = (left - segment.start.x) / along.x, at_right = at_left + cell_size_.x / along.x;
      from = std::clamp(std::min(at_left, at_right), 0.0, 1.0);
      to = std::clamp(std::max(at_left, at_right), 0.0, 1.0);
    }
    const auto [bottom, top] = std::minmax({cell(segment.start + from * along, 1), cell(segment.start + to * along, 1)});
    for (std::size_t row = bottom - std::min(bottom, margin); row <= std::min(top + margin, cells_ - 1); ++row)
      visit(row * cells_ + column);
  }
}

void Crossings::find(std::uint32_t index, std::vector<double>& fractions) const {
  fractions.clear();
  const Segment& own = segments_[index];
  const double nearest = own.nearest();
  visit_cells(own, 0, [&](std::size_t cell_index) {
    for (std::uint32_t entry = first_[cell_index]; entry < first_[cell_index + 1]; ++entry) {
      const Segment& other = segments_[inside_[entry]];
      if (other.furthest() <= nearest) continue;
      const dvec2 offset = other.start - own.start;
      const double area = cross(own.along, other.along), size = std::abs(area);
      const double here = std::copysign(1.0, area) * cross(offset, other.along),
                   there = std::copysign(1.0, area) * cross(offset, own.along);  // times the area
      if (here <= 0.0 || here >= size || there < 0.0 || there > size || size <= tie_guard * own.length * other.length) continue;
      const double own_depth = own.start_depth + here / size * own.depth_change;
      if (other.start_depth + there / size * other.depth_change > own_depth) fractions.push_back(here / size);
    }
  });
  std::ranges::sort(fractions);
}

}  // namespace raytube
