// Ray queries against a mesh. Embree proposes a triangle in single precision; place and distance are found in double here.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// A ray in recentred coordinates. A ray that leaves a surface names the patch it leaves: a straight ray cannot meet the
/// plane it starts on again, so that patch is never hit, however thin the gap to the next one.
struct Ray {
  dvec3 origin;
  dvec3 direction;  // unit
  std::uint32_t source_patch = no_index;
};

struct Hit {
  std::uint32_t triangle = no_index;
  double distance = 0.0;  // along the ray [m], to the plane of the triangle's patch
  explicit operator bool() const { return triangle != no_index; }
};

/// Patches that a query leaves out; no_index fills the rest.
using IgnoredPatches = std::array<std::uint32_t, 3>;
inline constexpr IgnoredPatches nothing_ignored{no_index, no_index, no_index};

class Tracer {
 public:
  /// Builds the ray-tracing structure; keeps a reference to `mesh`, which must outlive the tracer. Rays go to Embree `packet` at
  /// a time (1 or 16); nothing but speed depends on it.
  explicit Tracer(const TriangleMesh& mesh, int packet = 16);
  ~Tracer();
  Tracer(Tracer&&) noexcept;

  const TriangleMesh& mesh() const;

  /// The nearest surface each ray meets: in double precision, rims included, ties to the lower index - whatever Embree makes of
  /// it in single precision with the instruction set at hand. Thread-safe. hits.size() == rays.size().
  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const;

  /// The same without the distances; no_index where there is none. found.size() == rays.size().
  void closest_triangles(std::span<const Ray> rays, std::span<std::uint32_t> found) const;

  /// The nearest triangle that the half line from `origin` along `direction` meets, other than those of some patches; no_index if
  /// there is none. Thread-safe.
  std::uint32_t blocker(const dvec3& origin, const dvec3& direction, const IgnoredPatches& ignored_patches) const;
  /// The same for many half lines; best if they lie side by side. found.size() == rays.size().
  void blockers(std::span<const Ray> rays, const IgnoredPatches& ignored_patches, std::span<std::uint32_t> found) const;

  /// Double-precision decision whether the half line meets `triangle` or one that shares a corner with it. Thread-safe.
  bool meets_around(const dvec3& origin, const dvec3& direction, std::uint32_t triangle,
                    const IgnoredPatches& ignored_patches) const;

  /// The triangles of other patches so close to this one that single precision cannot tell which of them a ray meets, in
  /// ascending order.
  std::span<const std::uint32_t> near_coincident(std::uint32_t triangle) const;

  struct Scene;

 private:
  std::unique_ptr<Scene> scene_;
};

}  // namespace raytube
