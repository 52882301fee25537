// Ray queries against a mesh. Embree proposes a triangle in single precision; place and distance are found in double here.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "mesh/triangle_mesh.h"

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

class Tracer {
 public:
  /// Builds the ray-tracing structure; keeps a reference to `mesh`, which must outlive the tracer.
  explicit Tracer(const TriangleMesh& mesh);
  ~Tracer();
  Tracer(Tracer&&) noexcept;

  const TriangleMesh& mesh() const;

  /// The nearest surface each ray meets. Thread-safe. hits.size() == rays.size().
  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const;

  /// True if something other than the two named patches lies on the half line from `origin` along `direction`. Thread-safe.
  bool occluded(const dvec3& origin, const dvec3& direction, std::uint32_t ignored_patch,
                std::uint32_t other_ignored_patch) const;

  /// The instruction set Embree chose on this machine.
  std::string instruction_set() const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace raytube
