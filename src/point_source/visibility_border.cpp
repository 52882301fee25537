#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>

#include "point_source/source_visibility.h"

namespace raytube {

namespace {

struct Interval {
  double low, high;
};

// The part of the edge from a to b that the edge from c to d lies on; low >= high if none.
Interval common_part(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d, double tolerance) {
  const dvec3 along = b - a;
  const double length = glm::length(along);
  const auto beside = [&](const dvec3& p) { return glm::length(glm::cross(p - a, along)) > tolerance * length; };
  if (length <= tolerance || beside(c) || beside(d)) return {0.0, 0.0};
  const double first = glm::dot(c - a, along) / (length * length), second = glm::dot(d - a, along) / (length * length);
  return {std::max(0.0, std::min(first, second)), std::min(1.0, std::max(first, second))};
}

// What the intervals leave of the edge.
void add_rest(const dvec3& a, const dvec3& b, std::vector<Interval>& covered, double tolerance, std::vector<Segment>& border) {
  std::ranges::sort(covered, {}, &Interval::low);
  const double least = tolerance / glm::length(b - a);
  double at = 0.0;
  const auto add = [&](double to) {
    if (to - at > least) border.push_back({a + at * (b - a), a + to * (b - a)});
  };
  for (const Interval& interval : covered) {
    add(interval.low);
    at = std::max(at, interval.high);
  }
  add(1.0);
}

void find_border(std::vector<VisiblePiece>& pieces, std::span<const std::uint32_t> coplanar, std::uint32_t number,
                 double tolerance) {
  const SpatialPolygon& outline = pieces[number].outline;
  std::vector<Interval> covered;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const dvec3 &a = outline[i], &b = outline[i + 1 < outline.size() ? i + 1 : 0];
    if (glm::length(b - a) <= tolerance) continue;
    covered.clear();
    for (const std::uint32_t other : coplanar) {
      if (other == number) continue;
      const SpatialPolygon& next = pieces[other].outline;
      for (std::size_t k = 0; k < next.size(); ++k) {
        const Interval part = common_part(a, b, next[k], next[k + 1 < next.size() ? k + 1 : 0], tolerance);
        if (part.low < part.high) covered.push_back(part);
      }
    }
    add_rest(a, b, covered, tolerance, pieces[number].border);
  }
}

}  // namespace

void find_borders(const TriangleMesh& mesh, double tolerance, std::vector<VisiblePiece>& pieces) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> by_patch;
  for (std::uint32_t i = 0; i < pieces.size(); ++i) by_patch[mesh.triangle_patch[pieces[i].triangle]].push_back(i);
  tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(pieces.size()), [&](std::uint32_t i) {
    find_border(pieces, by_patch.at(mesh.triangle_patch[pieces[i].triangle]), i, tolerance);
  });
}

}  // namespace raytube
