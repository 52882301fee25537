// Lines of sight: through which sheets the receiver sees currents.
#pragma once

#include <vector>

#include "sbr/beams/beam_tree.h"
#include "sbr/visible/beam_visibility.h"

namespace raytube {

/// Where the sheets of a target are, as a receiver sees them: places by their components along theta_hat and phi_hat.
class LineOfSightSheets {
 public:
  LineOfSightSheets(const TriangleMesh& mesh, std::span<const Material> materials, const SphericalBasis& receive);

  const SphericalBasis& receive() const { return receive_; }
  dvec2 place(const dvec3& r) const { return {glm::dot(receive_.theta_hat, r), glm::dot(receive_.phi_hat, r)}; }
  /// False if none can stand between the receiver and what lies in this box, no nearer to the receiver than this.
  bool may_cover(const Bounds& box, double farthest) const { return farthest < nearest_ && box.overlaps(box_, 0.0); }
  bool may_cover(const dvec3& r) const { return may_cover({place(r), place(r)}, glm::dot(receive_.radial, r)); }

 private:
  SphericalBasis receive_;
  Bounds box_;
  double nearest_;  // to the receiver, along the line of sight
};

/// Currents seen through a sheet: what BeamTree::through_screen() says of them belongs to this part of their tube.
struct ScreenedPart {
  std::uint32_t node;
  ConvexPolygon outline;  // in launch coordinates
};

/// For tubes of polygonal cross-section. All that stands in their way cuts their lines of sight; sheets are looked through, other
/// surfaces passed by: their shadows are currents, too.
class PolygonLineOfSight {
 public:
  PolygonLineOfSight(const LineOfSightSheets& sheets, const FaceTree& tree, const Tracer& tracer, VisibleSurfaces& visible,
                     BeamTree& beams)
      : sheets_(sheets), tree_(tree), tracer_(tracer), visible_(visible), beams_(beams) {}

  /// The parts of a footprint that are seen through sheets, one more for each sheet there is on the way.
  std::vector<ScreenedPart> through_sheets(std::uint32_t node, const ConvexPolygon& outline);

 private:
  void look(std::uint32_t node, std::uint32_t patch, const dvec3& base, const ConvexPolygon& region);
  void look_from_middle(std::uint32_t node, const Beam& leaving, const ConvexPolygon& outline);

  const LineOfSightSheets& sheets_;
  const FaceTree& tree_;
  const Tracer& tracer_;
  VisibleSurfaces& visible_;
  BeamTree& beams_;
  std::vector<ScreenedPart> seen_;
};

/// For tubes of one ray each.
class RayLineOfSight {
 public:
  struct Line {
    std::uint32_t tube, node;
    Ray ray;
  };

  RayLineOfSight(const LineOfSightSheets& sheets, const Tracer& tracer) : sheets_(sheets), tracer_(tracer) {}

  /// A tube's currents at a place on a patch.
  void add(std::uint32_t tube, std::uint32_t node, const dvec3& place, std::uint32_t patch) {
    if (sheets_.may_cover(place)) lines_.push_back({tube, node, {place, sheets_.receive().radial, patch}});
  }

  /// Calls visit(tube, node) for every sheet on the way of every line added, and forgets them. Counts rays.
  template <class Visit>
  std::uint64_t through_sheets(BeamTree& beams, Visit visit);

 private:
  void trace();

  const LineOfSightSheets& sheets_;
  const Tracer& tracer_;
  std::vector<Line> lines_;  // of those that trace() leaves the rays start where they met something
};

template <class Visit>
std::uint64_t RayLineOfSight::through_sheets(BeamTree& beams, Visit visit) {
  std::uint64_t rays = 0;
  while (!lines_.empty()) {
    rays += lines_.size();
    trace();
    for (Line& line : lines_) {
      if (!beams.is_sheet(line.ray.source_patch)) continue;
      line.node = beams.through_screen(line.node, line.ray.source_patch);
      visit(line.tube, line.node);
    }
  }
  return rays;
}

}  // namespace raytube
