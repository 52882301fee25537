#include "mesh/patches.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/edge_table.h"

namespace raytube {

namespace {

constexpr double normal_tolerance = 3e-3;   // [rad]
constexpr double far_nearer = 1e-3;         // times the distance: such a difference says where a sliver belongs
constexpr double sliver_uncertainty = 0.1;  // of the normal [rad], from which on a triangle's normal says nothing

/// Compensated summation: a plain sum over a million triangles would tilt the plane by 1e-13.
template <class Vector>
class Sum {
 public:
  void add(const Vector& term) {
    const Vector corrected = term - lost_;
    const Vector total = value_ + corrected;
    lost_ = (total - value_) - corrected;
    value_ = total;
  }
  const Vector& value() const { return value_; }

 private:
  Vector value_{0.0};
  Vector lost_{0.0};
};

/// A plane through many triangles: normal and centroid weighted by area, so that the more it holds the better it is known.
class GrowingPlane {
 public:
  void add(const dvec3& a, const dvec3& b, const dvec3& c) {
    const dvec3 area = area_vector(a, b, c);
    area_.add(area);
    moment_.add(glm::length(area) * glm::dvec4((a + b + c) / 3.0, 1.0));
  }

  Patch plane() const {
    const dvec3 normal = glm::normalize(area_.value());
    return {normal, glm::dot(normal, dvec3(moment_.value())) / moment_.value().w};
  }

 private:
  Sum<dvec3> area_;
  Sum<glm::dvec4> moment_;  // weight times centroid, weight
};

class PatchFinder {
 public:
  PatchFinder(TriangleMesh& mesh, double distance)
      : mesh_(mesh), edges_(mesh.triangles, mesh.vertices.size()), distance_(distance) {}

  void run() {
    mesh_.patches.clear();
    mesh_.triangle_patch.assign(mesh_.triangles.size(), no_index);
    const std::vector<std::uint32_t> seeds = largest_first();
    for (const std::uint32_t seed : seeds)
      if (mesh_.triangle_patch[seed] == no_index && !is_sliver(seed)) grow(seed);
    for (const std::uint32_t seed : seeds)
      if (mesh_.triangle_patch[seed] == no_index && !join_nearest(seed)) grow(seed);
  }

 private:
  std::vector<std::uint32_t> largest_first() const {
    std::vector<double> area;
    for (const Triangle& t : mesh_.triangles) area.push_back(glm::length(area_vector(mesh_.vertices, t)));
    std::vector<std::uint32_t> order(area.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return area[a] > area[b]; });
    return order;
  }

  void grow(std::uint32_t seed) {
    const auto patch = static_cast<std::uint32_t>(mesh_.patches.size());
    GrowingPlane growing;
    std::vector<std::uint32_t> queue;
    const auto take = [&](std::uint32_t triangle) {
      const auto& [a, b, c] = mesh_.triangles[triangle];
      growing.add(mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]);
      mesh_.triangle_patch[triangle] = patch;
      queue.push_back(triangle);
    };
    take(seed);
    for (std::size_t i = 0; i < queue.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t next = neighbour(queue[i], k);
        if (next != no_index && mesh_.triangle_patch[next] == no_index && fits(growing.plane(), next)) take(next);
      }
    mesh_.patches.push_back(growing.plane());
  }

  /// The one other triangle of the same component at this side; no_index if there are more or none.
  std::uint32_t neighbour(std::uint32_t triangle, int corner) const {
    std::uint32_t found = no_index;
    for (const auto& side : edges_[edges_.edge_of(triangle, corner)].sides) {
      if (side.triangle == triangle || mesh_.triangle_component[side.triangle] != mesh_.triangle_component[triangle]) continue;
      if (found != no_index) return no_index;
      found = side.triangle;
    }
    return found;
  }

  /// Near the plane with all corners, and facing the same way. A triangle's own normal is known no better than the distance
  /// over its height, and that of a sliver may even point backwards; no way to tell it from a fold, and no need to.
  bool fits(const Patch& plane, std::uint32_t triangle) const {
    const Triangle& t = mesh_.triangles[triangle];
    const double farthest = distance_from(plane, t);
    if (farthest > distance_) return false;
    if (is_sliver(triangle)) return farthest <= far_nearer * distance_ || !fits_elsewhere(triangle, farthest);
    const dvec3 area = area_vector(mesh_.vertices, t);
    const double angle = std::atan2(glm::length(glm::cross(area, plane.normal)), glm::dot(area, plane.normal));
    return angle <= normal_tolerance + distance_ / height(mesh_.vertices, t);
  }

  bool is_sliver(std::uint32_t triangle) const {
    return distance_ > sliver_uncertainty * height(mesh_.vertices, mesh_.triangles[triangle]);
  }

  /// What no plane has reached belongs to the nearest one beside it; false if none is near enough.
  bool join_nearest(std::uint32_t triangle) {
    double nearest = distance_;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t next = neighbour(triangle, k), patch = next == no_index ? no_index : mesh_.triangle_patch[next];
      if (patch == no_index || distance_from(mesh_.patches[patch], mesh_.triangles[triangle]) > nearest) continue;
      nearest = distance_from(mesh_.patches[patch], mesh_.triangles[triangle]);
      mesh_.triangle_patch[triangle] = patch;
    }
    return mesh_.triangle_patch[triangle] != no_index;
  }

  double distance_from(const Patch& plane, const Triangle& t) const {
    double farthest = 0.0;
    for (const std::uint32_t v : t)
      farthest = std::max(farthest, std::abs(glm::dot(plane.normal, mesh_.vertices[v]) - plane.offset));
    return farthest;
  }

  /// A sliver along the edge of two planes lies in the one it is far nearer to, if coordinates are as good as to tell.
  bool fits_elsewhere(std::uint32_t triangle, double farthest) const {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t next = neighbour(triangle, k);
      if (next == no_index || is_sliver(next)) continue;
      GrowingPlane other;
      const auto& [a, b, c] = mesh_.triangles[next];
      other.add(mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]);
      if (distance_from(other.plane(), mesh_.triangles[triangle]) < far_nearer * farthest) return true;
    }
    return false;
  }

  TriangleMesh& mesh_;
  EdgeTable edges_;
  double distance_;
};

}  // namespace

void find_patches(TriangleMesh& mesh, double distance) { PatchFinder(mesh, distance).run(); }

}  // namespace raytube
