// Double-precision decisions about one ray and one triangle, and the neighbours a ray near an edge may have met instead.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "mesh/model/triangle_tree.h"
#include "mesh/trace/near_coincident.h"
#include "mesh/trace/ray.h"

namespace raytube {

/// What is decided in double for one ray and triangles of one mesh. Thread-safe.
class ExactHit {
 public:
  /// Keeps a reference to the mesh. Of lists longer than `longest_list` those that a ray comes near are found in a tree: the
  /// decisions are those of the lists, at bounded cost.
  explicit ExactHit(const TriangleMesh& mesh, std::size_t longest_list = 256);

  std::uint32_t patch(std::uint32_t triangle) const { return mesh_.triangle_patch[triangle]; }

  /// Distance along the ray to the plane of the triangle's patch [m].
  double distance(const Ray& ray, std::uint32_t triangle) const {
    return mesh_.patch_of(triangle).distance(ray.origin, ray.direction);
  }

  /// The hit of a ray on a triangle that it meets, or none for no_index.
  Hit hit(const Ray& ray, std::uint32_t triangle) const {
    return triangle == no_index ? Hit() : Hit{triangle, distance(ray, triangle), meets_from_inside(ray, triangle)};
  }

  /// What tells which of two triangles that contain the ray is the nearer one [m]: distance(), or where the ray grazes the patch
  /// the distance to the triangle itself.
  double depth(const Ray& ray, std::uint32_t triangle) const;

  /// True if the plane of the triangle's patch lies ahead of the ray's start by more than the rounding of the two.
  bool ahead(const Ray& ray, std::uint32_t triangle) const { return plane_ahead(ray, patch(triangle)); }
  bool plane_ahead(const Ray& ray, std::uint32_t patch) const {
    const Patch& plane = mesh_.patches[patch];
    const double height = plane.offset - glm::dot(plane.normal, ray.origin);
    return std::abs(height) > rounding_ && height * glm::dot(plane.normal, ray.direction) > 0.0;
  }

  /// True if the ray's line runs through the triangle, border included; without rounding, so no line slips between two triangles
  /// of an edge, or through where several meet in a corner.
  bool contains(const Ray& ray, std::uint32_t triangle) const;

  /// True if it contains the ray ahead of its start, and is not on the patch the ray leaves or an ignored one.
  bool meets(const Ray& ray, std::uint32_t triangle, const IgnoredPatches& ignored_patches) const {
    Hit hit;
    keep_nearer(ray, triangle, ignored_patches, hit);
    return static_cast<bool>(hit);
  }

  /// True if the ray passes well inside all three edges: single precision cannot have mistaken this hit but for one with a
  /// near-coincident facet.
  bool is_inside(const Ray& ray, std::uint32_t triangle) const;

  /// The triangles of other patches near to coincident with it, in ascending order.
  std::span<const std::uint32_t> near_coincident(std::uint32_t triangle) const { return near_coincident_[triangle]; }

  /// True if no other facet is near to coincident with the triangle.
  bool is_alone(std::uint32_t triangle) const { return near_coincident_[triangle].empty(); }

  /// The nearest triangle that contains the ray, among `triangle`, its near-coincident ones, and all of a patch of these which
  /// the ray runs along, but not on the patch the ray leaves or an ignored one; ties to the lower index.
  Hit nearest_near_coincident(const Ray& ray, std::uint32_t triangle, const IgnoredPatches& ignored_patches) const;

  /// A ray this far inside all three edges of a triangle of the mesh meets it in single precision too [m].
  static double edge_uncertainty(const TriangleMesh& mesh);
  double edge_uncertainty() const { return edge_uncertainty_; }  // of its mesh

  /// The nearest triangle that contains the ray, among `triangle`, those sharing a corner with it, its near-coincident ones,
  /// and all of a patch there which the ray grazes, but not on the patch the ray leaves or an ignored one; ties to the lower
  /// index.
  Hit nearest_around(const Ray& ray, std::uint32_t triangle, const IgnoredPatches& ignored_patches) const;

  /// A ray that touches a ridge of a closed body, or two of its facets that lie upon one another, meets both faces there, and
  /// rounding says which is the nearer one. If `hit` is on the one turned away, the hit on the other one; else `hit`.
  Hit front_of(const Ray& ray, const Hit& hit, const IgnoredPatches& ignored_patches) const;

  /// True if the ray meets the triangle of a closed body from inside.
  bool meets_from_inside(const Ray& ray, std::uint32_t triangle) const {
    return glm::dot(mesh_.patch_of(triangle).normal, ray.direction) > 0.0 && mesh_.closed(triangle);
  }

  /// True if a ray that does not run inside a closed body meets one from inside.
  bool is_lost(const Ray& ray, std::uint32_t triangle) const { return meets_from_inside(ray, triangle) && !leaves_inwards(ray); }

  /// True if a ray that leaves a patch starts beneath a facet turned away only by as much as facets may be off the planes of
  /// their patches.
  bool begins_beneath(const Ray& ray, std::uint32_t triangle) const;

  /// A ray that leaves a patch, moved back by as much along the way on which it came to be reflected.
  Ray moved_back(const Ray& ray) const;

 private:
  std::array<double, 3> edge_sides(const Ray& ray, std::uint32_t triangle) const;
  double depth(const Ray& ray, std::uint32_t triangle, const std::array<double, 3>& sides) const;
  void keep_nearer(const Ray& ray, std::uint32_t candidate, const IgnoredPatches& ignored_patches, Hit& nearest) const;
  bool leaves_inwards(const Ray& ray) const;
  double start_uncertainty(const Ray& ray) const;
  bool grazes(const Ray& ray, std::uint32_t patch) const;
  bool stays_off(const Ray& ray, std::uint32_t patch) const;
  bool is_long(std::span<const std::uint32_t> list) const { return list.size() > longest_list_; }
  bool has_long_corner(std::uint32_t triangle) const;
  bool has_corner_on(std::uint32_t triangle, std::uint32_t patch) const;
  void keep_nearer_of_patch(const Ray& ray, std::uint32_t grazed, const IgnoredPatches& ignored_patches, Hit& nearest) const;
  template <class Accept>
  void keep_nearer_of_all(const Ray& ray, const IgnoredPatches& ignored_patches, Hit& nearest, Accept accept) const;
  template <class Accept>
  void keep_nearer_of(std::span<const std::uint32_t> list, const Ray& ray, const IgnoredPatches& ignored_patches, Hit& nearest,
                      Accept accept) const;

  const TriangleMesh& mesh_;
  std::size_t longest_list_;
  double rounding_;
  double edge_uncertainty_;
  double plane_uncertainty_;  // of the height of a facet of one patch over the plane of another patch beside it [m]
  TriangleTree tree_;
  const TriangleRows &at_vertex_, &of_patch_;
  NearCoincident near_coincident_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> patches_at_;  // of vertices with long lists, ascending
};

}  // namespace raytube
