#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "mesh/model/edge_table.h"
#include "mesh/repair/steps.h"

namespace raytube {

namespace {

constexpr double normal_tolerance = 3e-3;   // [rad]
constexpr double far_nearer = 1e-3;         // times the distance: such a difference says where a sliver belongs
constexpr double farthest_steps = 12.0;     // that it is moved: farther only if planes meet nearly along it
constexpr double exact = 1e-13;             // of the extent: nothing to mend
constexpr double least_sine = 0.05;         // of a plane to others, that vertices are put on
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
  void add(const std::array<dvec3, 3>& corners) {
    const auto& [a, b, c] = corners;
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

/// Of two points that are not the same the first one, by their coordinates.
bool before(const dvec3& a, const dvec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// A triangle with its corners in an order of their own.
struct Seed {
  std::uint32_t triangle;
  std::array<dvec3, 3> corners;
};

/// A plane across a side of a triangle.
struct Beside {
  std::uint32_t patch;
  double distance;  // of the triangle from it
  double length;    // of the side
  std::array<dvec3, 2> ends;
};

class PatchFinder {
 public:
  PatchFinder(TriangleMesh& mesh, double distance) : mesh_(mesh), edges_(mesh.edges()), distance_(distance) {}

  void run() {
    mesh_.patches.clear();
    mesh_.triangle_patch.assign(mesh_.triangles.size(), no_index);
    const std::vector<std::uint32_t> seeds = largest_first();
    for (const std::uint32_t seed : seeds)
      if (mesh_.triangle_patch[seed] == no_index && !is_sliver(seed)) grow(seed);
    for (const std::uint32_t seed : seeds)
      if (mesh_.triangle_patch[seed] == no_index && !join_nearest(seed)) grow(seed);
  }

  /// Puts vertices on the planes of their patches of several triangles, unless more than rounding parts them.
  void flatten() {
    if (mesh_.coordinate_step <= 0.0) return;
    std::vector<std::uint32_t> counts(mesh_.patches.size());
    std::vector<double> off(mesh_.patches.size());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      const std::uint32_t patch = mesh_.triangle_patch[t];
      ++counts[patch];
      off[patch] = std::max(off[patch], distance_from(mesh_.patches[patch], mesh_.triangles[t]));
    }
    const double extent = bounding_box(mesh_.vertices).diagonal();
    std::vector<std::uint32_t> planes;  // of one vertex
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
      planes.clear();
      for (const std::uint32_t t : mesh_.at_vertex()[v])
        if (const std::uint32_t p = mesh_.triangle_patch[t]; counts[p] > 1 && off[p] <= rounding_steps * mesh_.coordinate_step)
          planes.push_back(p);
      std::ranges::sort(planes);
      planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
      put_on_planes(mesh_.vertices[v], planes, extent);
    }
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (counts[mesh_.triangle_patch[t]] == 1 && height(mesh_.vertices, mesh_.triangles[t]) > 0.0)
        mesh_.patches[mesh_.triangle_patch[t]] = plane_of(t);
  }

  /// Cuts the patches where materials meet. The piece with a patch's first triangle takes its number, the others follow behind.
  void cut(std::span<const std::uint32_t> materials) {
    const std::vector<std::uint32_t> pieces = connected_pieces(materials);
    std::vector<std::uint32_t> patch_of_piece(mesh_.triangles.size(), no_index);
    std::vector<bool> taken(mesh_.patches.size(), false);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      std::uint32_t& patch = patch_of_piece[pieces[t]];
      if (patch == no_index) {
        patch = mesh_.triangle_patch[t];
        if (taken[patch])
          patch = copy_of(patch);
        else
          taken[patch] = true;
        mesh_.patches[patch].material = materials[t];
      }
      mesh_.triangle_patch[t] = patch;
    }
  }

 private:
  /// A number for each triangle, in common with those of its patch that it reaches across edges without leaving its material.
  std::vector<std::uint32_t> connected_pieces(std::span<const std::uint32_t> materials) const {
    DisjointSets pieces(mesh_.triangles.size());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t next = neighbour(t, k);
        if (next == no_index || mesh_.triangle_patch[next] != mesh_.triangle_patch[t] || materials[next] != materials[t])
          continue;
        pieces.join(t, next);
      }
    return pieces.numbers();
  }

  /// To where these planes meet, three at most, in order of their largest triangles: to each of them along its normal without
  /// leaving those before (Gram-Schmidt). A plane that is almost one of these is left alone.
  void put_on_planes(dvec3& vertex, std::span<const std::uint32_t> planes, double extent) const {
    const auto off = [&](std::uint32_t p) { return mesh_.patches[p].height(vertex); };
    if (std::ranges::none_of(planes, [&](std::uint32_t p) { return std::abs(off(p)) > exact * extent; })) return;
    const dvec3 as_read = vertex;
    for (int round = 0; round < 2; ++round) {  // the second one mends rounding
      std::array<dvec3, 3> before;
      std::size_t count = 0;
      for (const std::uint32_t p : planes) {
        dvec3 way = mesh_.patches[p].normal;
        for (std::size_t i = 0; i < count; ++i) way -= glm::dot(way, before[i]) * before[i];
        const double sine = glm::length(way);
        if (count == 3 || sine < least_sine) continue;
        before[count++] = way / sine;
        vertex -= off(p) / sine * before[count - 1];
      }
    }
    if (glm::distance(vertex, as_read) > farthest_steps * mesh_.coordinate_step) vertex = as_read;
  }

  Patch plane_of(std::uint32_t triangle) const {
    GrowingPlane plane;
    plane.add(mesh_.corners(triangle));
    return plane.plane();
  }

  std::uint32_t copy_of(std::uint32_t patch) {
    mesh_.patches.push_back(Patch(mesh_.patches[patch]));
    return static_cast<std::uint32_t>(mesh_.patches.size() - 1);
  }

  /// Of equal ones by coordinates: in which order a file lists triangles and their corners must not decide where a sliver
  /// belongs.
  std::vector<std::uint32_t> largest_first() const {
    std::vector<std::pair<double, std::uint32_t>> sizes;  // less than zero, triangle
    sizes.reserve(mesh_.triangles.size());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) sizes.emplace_back(-size_of(corners_in_order(t)), t);
    std::ranges::sort(sizes);
    std::vector<std::uint32_t> order;
    order.reserve(sizes.size());
    for (const auto& entry : sizes) order.push_back(entry.second);
    for (std::size_t first = 0, last = 0; first < sizes.size(); first = last) {
      while (last < sizes.size() && sizes[last].first == sizes[first].first) ++last;
      if (last - first > 1) sort_by_corners(std::span(order).subspan(first, last - first));
    }
    return order;
  }

  void sort_by_corners(std::span<std::uint32_t> triangles) const {
    std::vector<Seed> seeds;
    for (const std::uint32_t t : triangles) seeds.push_back({t, corners_in_order(t)});
    std::ranges::sort(
        seeds, [](const Seed& a, const Seed& b) { return std::ranges::lexicographical_compare(a.corners, b.corners, before); });
    std::ranges::transform(seeds, triangles.begin(), &Seed::triangle);
  }

  std::array<dvec3, 3> corners_in_order(std::uint32_t triangle) const {
    std::array<dvec3, 3> corners = mesh_.corners(triangle);
    std::ranges::sort(corners, before);
    return corners;
  }

  static double size_of(const std::array<dvec3, 3>& c) { return glm::length(area_vector(c[0], c[1], c[2])); }

  void grow(std::uint32_t seed) {
    const auto patch = static_cast<std::uint32_t>(mesh_.patches.size());
    GrowingPlane growing;
    queue_.clear();
    const auto take = [&](std::uint32_t triangle) {
      growing.add(mesh_.corners(triangle));
      mesh_.triangle_patch[triangle] = patch;
      queue_.push_back(triangle);
    };
    take(seed);
    for (std::size_t i = 0; i < queue_.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t next = neighbour(queue_[i], k);
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
  /// over its height, and that of a sliver may even point backwards; no way to tell it from a facet folded back, and no need to.
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

  /// What no plane has reached belongs to the nearest one beside it, of those as near as coordinates can tell to the one across
  /// its longest side; false if none is near enough.
  bool join_nearest(std::uint32_t triangle) {
    std::vector<Beside> beside;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t next = neighbour(triangle, k), patch = next == no_index ? no_index : mesh_.triangle_patch[next];
      if (patch == no_index) continue;
      const double distance = distance_from(mesh_.patches[patch], mesh_.triangles[triangle]);
      if (distance <= distance_) beside.push_back(neighbour_across(triangle, k, patch, distance));
    }
    if (beside.empty()) return false;
    const double nearest = std::ranges::min(beside, {}, &Beside::distance).distance + far_nearer * distance_;
    std::erase_if(beside, [&](const Beside& b) { return b.distance > nearest; });
    mesh_.triangle_patch[triangle] = std::ranges::min_element(beside, [](const Beside& a, const Beside& b) {
                                       if (a.length != b.length) return a.length > b.length;
                                       return std::ranges::lexicographical_compare(a.ends, b.ends, before);
                                     })->patch;
    return true;
  }

  Beside neighbour_across(std::uint32_t triangle, int corner, std::uint32_t patch, double distance) const {
    const Triangle& t = mesh_.triangles[triangle];
    std::array<dvec3, 2> ends{mesh_.vertices[t[corner]], mesh_.vertices[t[(corner + 1) % 3]]};
    std::ranges::sort(ends, before);
    return {patch, distance, glm::distance(ends[0], ends[1]), ends};
  }

  double distance_from(const Patch& plane, const Triangle& t) const {
    double farthest = 0.0;
    for (const std::uint32_t v : t) farthest = std::max(farthest, std::abs(plane.height(mesh_.vertices[v])));
    return farthest;
  }

  /// A sliver along the edge of two planes lies in the one it is far nearer to, if coordinates are as good as to tell.
  bool fits_elsewhere(std::uint32_t triangle, double farthest) const {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t next = neighbour(triangle, k);
      if (next == no_index || is_sliver(next)) continue;
      if (distance_from(plane_of(next), mesh_.triangles[triangle]) < far_nearer * farthest) return true;
    }
    return false;
  }

  TriangleMesh& mesh_;
  const EdgeTable& edges_;
  double distance_;
  std::vector<std::uint32_t> queue_;  // of a patch that grows
};

}  // namespace

void find_patches(TriangleMesh& mesh, double distance, std::span<const std::uint32_t> materials) {
  PatchFinder finder(mesh, distance);
  finder.run();
  finder.flatten();
  if (!materials.empty()) finder.cut(materials);
  mesh.patches.shrink_to_fit();
}

}  // namespace raytube
