// Fans of rays that leave a line side by side, all in one plane: parallel ones, or those of a point. What they meet, exactly.
#pragma once

#include "mesh/model/face_tree.h"
#include "mesh/trace/tracer.h"

namespace raytube {

/// The ray at position z leaves base + z step, from <= z <= to [m], and runs along direction + divergence z step. What it meets
/// at p of these vectors has the depth p / (1 + divergence p): the depth of a plane is linear in z, and nearer is less
/// (homography that makes the rays parallel).
struct RayFan {
  dvec3 base, step;
  dvec3 direction;  // unit, not along `step`
  double from, to;
  double divergence = 0.0;           // 1 over the distance of the point behind `base` [1/m]; negative: it lies ahead
  double begin = 0.0, growth = 0.0;  // the ray at z counts from the depth begin + growth z on [m]
};

/// Neighbouring rays that meet the same face first.
struct FanHit {
  std::uint32_t face;
  double from, to;        // positions [m]
  double length, growth;  // the ray at position z meets the face at the depth length + growth z [m]
};

/// The rays between the two positions of a hit after the reflection by the plane they have met.
RayFan reflected(const RayFan& fan, const FanHit& hit, const dvec3& normal);
/// The fan of rays of a point, by the image of the line they left.
RayFan reflected_image(const RayFan& fan, const FanHit& hit, const dvec3& normal, double offset);

/// The component of a plane's normal along the rays; for those of a point the same sign for all, and not of unit vectors.
double facing_of(const RayFan& fan, const Patch& plane);

/// Finds first hits. Keeps buffers between calls: one object a thread.
class RayFanTracer {
 public:
  explicit RayFanTracer(const FaceTree& tree) : tree_(tree) {}

  /// Fills `hits` (cleared first), in the order of positions, with what the rays meet first, but for faces of some patches.
  /// Closed bodies are met from outside only. The planes of faces that run through one another are told apart at the middle of
  /// what both cover.
  void trace(const RayFan& fan, const IgnoredPatches& ignored_patches, std::vector<FanHit>& hits);

  /// Counted, of all traces so far (utd/wedge/work.h).
  double work() const { return work_; }

 private:
  void gather(const RayFan& fan, const IgnoredPatches& ignored_patches);
  struct FanPlane;
  void intersect(const RayFan& fan, const FanPlane& in, std::uint32_t face, double facing);
  void collect_near(const RayFan& fan);
  void cut(const RayFan& fan);
  void go_on_to(double position);
  const FanHit* first_at(const RayFan& fan, double position) const;

  const FaceTree& tree_;
  std::vector<std::uint32_t> near_;
  std::vector<FanHit> crossed_;  // each face by itself
  std::vector<double> cuts_;
  std::vector<const FanHit*> coming_, covering_;  // faces by where they begin, and those that the position is in
  double work_ = 0.0;
};

}  // namespace raytube
