// Fans of rays: parallel ones that leave a line side by side, all in one plane. What they meet, exactly.
#pragma once

#include "mesh/model/face_tree.h"
#include "mesh/trace/tracer.h"

namespace raytube {

/// The ray at position z leaves base + z step, from <= z <= to [m].
struct RayFan {
  dvec3 base, step;
  dvec3 direction;  // unit, not along `step`
  double from, to;
};

/// Neighbouring rays that meet the same face first.
struct FanHit {
  std::uint32_t face;
  double from, to;        // positions [m]
  double length, growth;  // the ray at position z meets the face after length + growth z [m]
};

/// The rays between the two positions of a hit after the reflection by the plane they have met.
RayFan reflected(const RayFan& fan, const FanHit& hit, const dvec3& normal);

/// Finds first hits. Keeps buffers between calls: one object a thread.
class RayFanTracer {
 public:
  explicit RayFanTracer(const FaceTree& tree) : tree_(tree) {}

  /// Fills `hits` (cleared first), in the order of positions, with what the rays meet first, but for faces of some patches.
  /// Closed bodies are met from outside only. The planes of faces that run through one another are told apart at the middle of
  /// what both cover.
  void trace(const RayFan& fan, const IgnoredPatches& ignored_patches, std::vector<FanHit>& hits);

  /// Counted, of all traces so far (core/work.h).
  double work() const { return work_; }

 private:
  void gather(const RayFan& fan, const IgnoredPatches& ignored_patches);
  void intersect(const RayFan& fan, std::uint32_t face);
  void cut();
  void go_on_to(double position);
  const FanHit* first_at(double position) const;

  const FaceTree& tree_;
  std::vector<std::uint32_t> near_;
  std::vector<FanHit> crossed_;  // each face by itself
  std::vector<double> cuts_;
  std::vector<const FanHit*> coming_, covering_;  // faces by where they begin, and those that the position is in
  double work_ = 0.0;
};

}  // namespace raytube
