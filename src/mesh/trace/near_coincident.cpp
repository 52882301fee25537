#include "mesh/trace/near_coincident.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/model/triangle_pairs.h"

namespace raytube {

namespace {

using ArcBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

constexpr std::size_t few_triangles = 32;  // round a vertex, of which each is held against each

// A triangle as one of its corners sees it; shorter than half a circle, about the origin.
struct Arc {
  dvec3 from, to, axis;
  double angle;
  Arc(const dvec3& first, const dvec3& second)
      : from(glm::normalize(first)),
        to(glm::normalize(second)),
        axis(glm::normalize(glm::cross(first, second))),
        angle(std::atan2(glm::length(glm::cross(from, to)), glm::dot(from, to))) {}

  dvec3 middle() const { return glm::normalize(from + to); }

  // The point `p` lies over the arc, between its ends.
  bool beside(const dvec3& p) const {
    return glm::dot(glm::cross(axis, from), p) >= 0.0 && glm::dot(glm::cross(to, axis), p) >= 0.0;
  }

  // Chord from a unit vector to the nearest point of the arc.
  double distance(const dvec3& p) const {
    if (beside(p)) return std::abs(glm::dot(axis, p));
    return std::min(glm::distance(p, from), glm::distance(p, to));
  }

  // To the nearer end from where `p` lies over the arc.
  double angle_to_end(const dvec3& p) const {
    const double from_first = std::atan2(glm::dot(glm::cross(axis, from), p), glm::dot(from, p));
    return std::min(from_first, angle - from_first);
  }

  bool crosses(const Arc& other) const {
    const double a = glm::dot(other.axis, from), b = glm::dot(other.axis, to);
    const double c = glm::dot(axis, other.from), d = glm::dot(axis, other.to);
    return a * b < 0.0 && c * d < 0.0 && a * c < 0.0;
  }
};

bool comes_near(const Arc& arc, const Arc& other, double narrow) {
  if (other.distance(arc.middle()) < 0.5 * narrow * arc.angle) return true;
  return std::ranges::any_of(std::array{other.from, other.to}, [&](const dvec3& end) {
    return arc.beside(end) && std::abs(glm::dot(arc.axis, end)) < narrow * arc.angle_to_end(end);
  });
}

// True if somewhere on one of the arcs the other one is nearer than `narrow` times the way to the end: from there outwards the
// triangles are nearer to one another than that times the way to their edges. Arcs that follow one another are not. The
// distance is least over the middle of an arc or beside an end of the other one: between these, it is concave.
bool open_narrowly(const Arc& a, const Arc& b, double narrow) {
  return a.crosses(b) || comes_near(a, b, narrow) || comes_near(b, a, narrow);
}

// Meets all arcs that come near this one, or that it comes near to: within half the narrow angle times its own, and a little.
ArcBox box_of(const Arc& arc, double narrow, std::uint32_t index) {
  const double margin = 0.6 * narrow * arc.angle;
  dvec3 low = glm::min(arc.from, arc.to), high = glm::max(arc.from, arc.to);
  // An arc rises above its chord by less than 1 - cos of half its angle.
  const double rise = 1.0 - std::cos(0.5 * arc.angle);
  low -= margin + rise;
  high += margin + rise;
  return {CGAL::Bbox_3(low.x, low.y, low.z, high.x, high.y, high.z), index};
}

class PairFinder {
 public:
  PairFinder(const TriangleMesh& mesh, const TriangleTree& tree, double distance, double narrow)
      : mesh_(mesh), distance_(distance), narrow_(narrow) {
    const auto are_close = [&](std::uint32_t a, std::uint32_t b) {
      return !are_apart(mesh_.corners(a), mesh_.corners(b), distance_);
    };
    for (const auto& [a, b] : tree.close_pairs(distance, are_close)) add(a, b);
    for (std::uint32_t vertex = 0; vertex < mesh.vertices.size(); ++vertex) look_round(vertex, mesh.at_vertex()[vertex]);
    const EdgeTable& edges = mesh.edges();
    for (std::size_t e = 0; e < edges.size(); ++e) look_along(edges[e]);
  }

  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;

 private:
  void add(std::uint32_t a, std::uint32_t b) { pairs.insert(pairs.end(), {{a, b}, {b, a}}); }

  bool share_one_corner(std::uint32_t a, std::uint32_t b) const {
    const Triangle& with = mesh_.triangles[b];
    return std::ranges::count_if(mesh_.triangles[a], [&](std::uint32_t v) { return has_corner(with, v); }) == 1;
  }

  Arc arc(std::uint32_t triangle, std::uint32_t vertex) const {
    const Triangle& t = mesh_.triangles[triangle];
    const std::uint32_t corner = corner_at(t, vertex);
    const dvec3& tip = mesh_.vertices[vertex];
    return {mesh_.vertices[t[(corner + 1) % 3]] - tip, mesh_.vertices[t[(corner + 2) % 3]] - tip};
  }

  void look_round(std::uint32_t vertex, std::span<const std::uint32_t> triangles) {
    if (are_one_patch(triangles)) return;
    arcs_.clear(), boxes_.clear();
    for (const std::uint32_t triangle : triangles) {
      arcs_.push_back(arc(triangle, vertex));
      boxes_.push_back(box_of(arcs_.back(), narrow_, static_cast<std::uint32_t>(boxes_.size())));
    }
    const auto look_at = [&](const ArcBox& a, const ArcBox& b) {
      const std::uint32_t i = a.info(), j = b.info(), t = triangles[i], u = triangles[j];
      if (patch(t) != patch(u) && share_one_corner(t, u) && open_narrowly(arcs_[i], arcs_[j], narrow_)) add(t, u);
    };
    if (triangles.size() <= few_triangles)
      look_at_all(look_at);
    else
      CGAL::box_self_intersection_d(boxes_.begin(), boxes_.end(), look_at);
  }

  template <class LookAt>
  void look_at_all(const LookAt& look_at) const {
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      for (std::size_t j = i + 1; j < boxes_.size(); ++j)
        if (CGAL::do_overlap(boxes_[i].bbox(), boxes_[j].bbox())) look_at(boxes_[i], boxes_[j]);
  }

  bool are_one_patch(std::span<const std::uint32_t> triangles) const {
    return std::ranges::all_of(triangles, [&](std::uint32_t t) { return patch(t) == patch(triangles[0]); });
  }

  std::uint32_t patch(std::uint32_t triangle) const { return mesh_.triangle_patch[triangle]; }

  // Triangles on a common edge that are folded together.
  void look_along(const EdgeTable::Edge& edge) {
    for (std::size_t i = 0; i < edge.sides.size(); ++i)
      for (std::size_t j = i + 1; j < edge.sides.size(); ++j) {
        const std::uint32_t a = edge.sides[i].triangle, b = edge.sides[j].triangle;
        if (patch(a) != patch(b) && glm::distance(inwards(edge.sides[i]), inwards(edge.sides[j])) < narrow_) add(a, b);
      }
  }

  dvec3 inwards(const EdgeTable::Side& side) const {
    const Triangle& t = mesh_.triangles[side.triangle];
    const dvec3 from = mesh_.vertices[t[side.corner]], edge = glm::normalize(mesh_.vertices[t[(side.corner + 1) % 3]] - from);
    const dvec3 to = mesh_.vertices[t[(side.corner + 2) % 3]] - from;
    return glm::normalize(to - glm::dot(to, edge) * edge);
  }

  const TriangleMesh& mesh_;
  double distance_, narrow_;
  std::vector<Arc> arcs_;      // of the triangles round one vertex
  std::vector<ArcBox> boxes_;  // of these
};

}  // namespace

NearCoincident::NearCoincident(const TriangleMesh& mesh, const TriangleTree& tree, double distance, double narrow)
    : first_(mesh.triangles.size() + 1, 0) {
  auto pairs = std::move(PairFinder(mesh, tree, distance, narrow).pairs);
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (const auto& [triangle, other] : pairs) ++first_[triangle + 1], others_.push_back(other);
  for (std::size_t t = 1; t < first_.size(); ++t) first_[t] += first_[t - 1];
  find_patches(mesh);
}

void NearCoincident::find_patches(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> found;
  first_patch_.reserve(first_.size());
  first_patch_.push_back(0);
  for (std::uint32_t triangle = 0; triangle + 1 < first_.size(); ++triangle) {
    found.clear();
    for (const std::uint32_t other : (*this)[triangle]) found.push_back(mesh.triangle_patch[other]);
    std::ranges::sort(found);
    patches_.insert(patches_.end(), found.begin(), std::unique(found.begin(), found.end()));
    first_patch_.push_back(static_cast<std::uint32_t>(patches_.size()));
  }
}

}  // namespace raytube
