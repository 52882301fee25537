#include "mesh/touching.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/geometry.h"

namespace raytube {

namespace {

using TriangleBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
using Corners = std::array<dvec3, 3>;

std::vector<TriangleBox> boxes_of(const TriangleMesh& mesh, double margin) {
  std::vector<TriangleBox> boxes;
  boxes.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Box box;
    for (const std::uint32_t v : mesh.triangles[t]) box.add(mesh.vertices[v]);
    box.low -= margin;
    box.high += margin;
    boxes.emplace_back(CGAL::Bbox_3(box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z), t);
  }
  return boxes;
}

// The gap between two triangles along an axis, above zero if they are apart; an axis without length tells nothing.
double gap_along(const Corners& a, const Corners& b, const dvec3& axis) {
  const double length = glm::length(axis);
  if (!(length > 0.0)) return 0.0;
  const auto range = [&](const Corners& corners) {
    return std::minmax({glm::dot(corners[0], axis), glm::dot(corners[1], axis), glm::dot(corners[2], axis)});
  };
  const auto [low_a, high_a] = range(a);
  const auto [low_b, high_b] = range(b);
  return std::max(low_a - high_b, low_b - high_a) / length;
}

// Whether a plane with a gap of this width on it separates the two (Gottschalk, Lin and Manocha 1996: for convex polyhedra it is
// enough to try the normals of both and the products of their edges; for flat ones also the normals of edges in their planes).
bool are_apart(const Corners& a, const Corners& b, double distance) {
  const dvec3 normals[2] = {area_vector(a[0], a[1], a[2]), area_vector(b[0], b[1], b[2])};
  for (const dvec3& normal : normals)
    if (gap_along(a, b, normal) > distance) return true;
  for (int i = 0; i < 3; ++i) {
    const dvec3 edge_a = a[(i + 1) % 3] - a[i], edge_b = b[(i + 1) % 3] - b[i];
    if (gap_along(a, b, glm::cross(normals[0], edge_a)) > distance) return true;
    if (gap_along(a, b, glm::cross(normals[1], edge_b)) > distance) return true;
    for (int j = 0; j < 3; ++j)
      if (gap_along(a, b, glm::cross(edge_a, b[(j + 1) % 3] - b[j])) > distance) return true;
  }
  return false;
}

// Shorter than half a circle, about the origin.
struct Arc {
  dvec3 from, to, axis;
  Arc(const dvec3& first, const dvec3& second)
      : from(glm::normalize(first)), to(glm::normalize(second)), axis(glm::normalize(glm::cross(first, second))) {}

  // Chord from a unit vector to the nearest point of the arc.
  double distance(const dvec3& p) const {
    const bool beside = glm::dot(glm::cross(axis, from), p) >= 0.0 && glm::dot(glm::cross(to, axis), p) >= 0.0;
    if (beside) return std::abs(glm::dot(axis, p));
    return std::min(glm::distance(p, from), glm::distance(p, to));
  }
  double distance_to_ends(const Arc& other) const { return std::min(distance(other.from), distance(other.to)); }

  bool crosses(const Arc& other) const {
    const double a = glm::dot(other.axis, from), b = glm::dot(other.axis, to);
    const double c = glm::dot(axis, other.from), d = glm::dot(axis, other.to);
    return a * b < 0.0 && c * d < 0.0 && a * c < 0.0;
  }
};

class Pairs {
 public:
  Pairs(const TriangleMesh& mesh, double distance, double narrow) : mesh_(mesh), distance_(distance), narrow_(narrow) {}

  bool touch(std::uint32_t a, std::uint32_t b) const {
    if (mesh_.triangle_patch[a] == mesh_.triangle_patch[b]) return false;
    const Triangle &first = mesh_.triangles[a], &second = mesh_.triangles[b];
    const auto common = [](const Triangle& of, const Triangle& with) {
      std::vector<int> corners;
      for (int k = 0; k < 3; ++k)
        if (std::ranges::find(with, of[k]) != with.end()) corners.push_back(k);
      return corners;
    };
    const std::vector<int> here = common(first, second), there = common(second, first);
    if (here.empty()) return !are_apart(corners(first, {}), corners(second, {}), distance_);
    if (here.size() == 1) return meet_at_corner(first, here[0], second, there[0]);
    return meet_at_edge(first, here, second, there);
  }

 private:
  Corners corners(const Triangle& t, const dvec3& origin) const {
    return {mesh_.vertices[t[0]] - origin, mesh_.vertices[t[1]] - origin, mesh_.vertices[t[2]] - origin};
  }

  // Seen from their common corner each is an arc on the unit sphere; two that are near cross, or an end of one is near the other.
  bool meet_at_corner(const Triangle& a, int corner_a, const Triangle& b, int corner_b) const {
    const dvec3 tip = mesh_.vertices[a[corner_a]];
    const auto arc = [&](const Triangle& t, int corner) {
      return Arc(mesh_.vertices[t[(corner + 1) % 3]] - tip, mesh_.vertices[t[(corner + 2) % 3]] - tip);
    };
    const Arc first = arc(a, corner_a), second = arc(b, corner_b);
    return first.crosses(second) || std::min(first.distance_to_ends(second), second.distance_to_ends(first)) < narrow_;
  }

  // Folded together.
  bool meet_at_edge(const Triangle& a, const std::vector<int>& here, const Triangle& b, const std::vector<int>& there) const {
    const dvec3 from = mesh_.vertices[a[here[0]]], edge = glm::normalize(mesh_.vertices[a[here[1]]] - from);
    const auto inwards = [&](const Triangle& t, const std::vector<int>& ends) {
      const dvec3 to = mesh_.vertices[t[3 - ends[0] - ends[1]]] - from;
      return glm::normalize(to - glm::dot(to, edge) * edge);
    };
    return glm::distance(inwards(a, here), inwards(b, there)) < narrow_;
  }

  const TriangleMesh& mesh_;
  double distance_, narrow_;
};

}  // namespace

Touching::Touching(const TriangleMesh& mesh, double distance, double narrow) : first_(mesh.triangles.size() + 1, 0) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  std::vector<TriangleBox> boxes = boxes_of(mesh, distance);
  const Pairs test(mesh, distance, narrow);
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const TriangleBox& a, const TriangleBox& b) {
    if (!test.touch(a.info(), b.info())) return;
    pairs.emplace_back(a.info(), b.info());
    pairs.emplace_back(b.info(), a.info());
  });
  std::ranges::sort(pairs);
  for (const auto& [triangle, other] : pairs) ++first_[triangle + 1], others_.push_back(other);
  for (std::size_t t = 1; t < first_.size(); ++t) first_[t] += first_[t - 1];
}

}  // namespace raytube
