// Ray queries against a mesh.
//
// Embree answers in single precision which triangle a ray meets; hit point and distance are found in double from the vertices of
// the mesh. Where single precision can be wrong - beside an edge, at facets near to coincident, along a plane - ExactHit decides
// among all triangles that it can have confused. What Embree is given are conservative proxy triangles (ProxyTriangles), so that
// it never overlooks a surface.
#pragma once

#include <memory>
#include <span>

#include "mesh/trace/ray.h"

namespace raytube {

/// Answers what rays meet. Rays that are not finite, or begin 1e18 radii away, meet nothing.
class Tracer {
 public:
  /// Builds the ray-tracing structure; keeps a reference to `mesh`, which must outlive the tracer. Rays go to Embree `packet` at
  /// a time (1 or 16); nothing but speed depends on it. Throws std::bad_alloc, or std::runtime_error where Embree fails.
  explicit Tracer(const TriangleMesh& mesh, int packet = 16);
  ~Tracer();
  /// Can be moved, not copied.
  Tracer(Tracer&&) noexcept;

  /// As given.
  const TriangleMesh& mesh() const;

  /// The nearest surface each ray meets: in double precision, borders included, ties to the lower index - whatever Embree makes
  /// of it in single precision with the instruction set at hand. Thread-safe. hits.size() == rays.size(). Rays that do not run
  /// side by side go to Embree alone, which is then faster.
  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits, bool side_by_side = true) const;

  /// The nearest triangle that the half line from `origin` along `direction` meets, other than those of some patches; no_index if
  /// there is none. Thread-safe.
  std::uint32_t blocker(const dvec3& origin, const dvec3& direction, const IgnoredPatches& ignored_patches) const;
  /// A triangle of other patches that each half line meets, nearest or not; no_index where there is none. Whether there is one
  /// does not depend on what Embree makes of it; which one may. Best if they lie side by side. found.size() == rays.size().
  /// Thread-safe.
  void any_blockers(std::span<const Ray> rays, const IgnoredPatches& ignored_patches, std::span<std::uint32_t> found) const;

  /// The nearest of `triangle` and those that share a corner with it which the half line meets, decided in double precision;
  /// no_index if it meets none of them. Thread-safe.
  std::uint32_t blocker_around(const dvec3& origin, const dvec3& direction, std::uint32_t triangle,
                               const IgnoredPatches& ignored_patches) const;

  /// The near-coincident facets: triangles of other patches so close to this one that single precision cannot tell which of them
  /// a ray meets, in ascending order.
  std::span<const std::uint32_t> near_coincident(std::uint32_t triangle) const;

  /// What Embree and the decision in double precision stand on.
  struct Scene;

 private:
  std::unique_ptr<Scene> scene_;
};

}  // namespace raytube
