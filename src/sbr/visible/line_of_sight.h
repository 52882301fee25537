// Line-of-sight transmission: through which sheets the waves of currents reach the receiver.
#pragma once

#include <vector>

#include "sbr/beams/beam_tree.h"
#include "sbr/visible/beam_visibility.h"

namespace raytube {

/// Where the sheets of a target are across the lines of sight of a receiver.
class LineOfSightSheets {
 public:
  /// `antenna`: a receiver at a finite distance; else null.
  LineOfSightSheets(const TriangleMesh& mesh, std::span<const Material> materials, const SphericalBasis& receive,
                    const Antenna* antenna = nullptr);

  const SphericalBasis& receive() const { return receive_; }
  /// The components of a point along theta_hat and phi_hat [m], or its launch coordinates in converging().
  dvec2 across(const dvec3& r) const {
    if (is_near()) return launch_coordinates(converging_, r);
    return {glm::dot(receive_.theta_hat, r), glm::dot(receive_.phi_hat, r)};
  }
  /// Whether lines of sight meet at a finite distance.
  bool is_near() const { return converging_.spherical(); }
  /// The wave that runs together in such a receiver, of a curvature below zero.
  const Beam& converging() const { return converging_; }
  /// Unit, from a point to the receiver.
  dvec3 towards_receiver(const dvec3& r) const;
  /// False if none can stand between the receiver and what lies in this box, no nearer to the receiver than this.
  bool may_cover(const Bounds& box, double farthest) const { return farthest < nearest_ && box.overlaps(box_, 0.0); }
  bool may_cover(const dvec3& r) const { return may_cover({across(r), across(r)}, depth(r)); }
  /// Whether sheets may stand before any of these points.
  bool may_cover_any(std::span<const dvec3> points) const;

 private:
  double depth(const dvec3& r) const;

  SphericalBasis receive_;
  Beam converging_;
  Bounds box_;
  double nearest_;  // to the receiver, along the line of sight
};

/// Currents whose waves reach the receiver through a sheet: the node that BeamTree::through_screen() makes of them belongs to
/// this part of their tube.
struct ScreenedPart {
  std::uint32_t node;
  ConvexPolygon outline;  // in launch coordinates
};

/// For tubes of polygonal cross-section. All that stands before the receiver divides them; sheets transmit, other surfaces are
/// passed by, since their shadows are currents, too.
class PolygonLineOfSight {
 public:
  PolygonLineOfSight(const LineOfSightSheets& sheets, const FaceTree& tree, const Tracer& tracer, BeamVisibility& visible,
                     BeamTree& beams)
      : sheets_(sheets), tree_(tree), tracer_(tracer), visible_(visible), beams_(beams) {}

  /// The parts of a footprint that stand behind sheets, one more for each sheet on the way to the receiver.
  std::vector<ScreenedPart> through_sheets(std::uint32_t node, const ConvexPolygon& outline);

 private:
  void follow_to_receiver(std::uint32_t node, const ConvexPolygon& outline);
  void follow(std::uint32_t node, std::uint32_t patch, const dvec3& base, const ConvexPolygon& region);
  void follow_from_middle(std::uint32_t node, const Beam& leaving, const ConvexPolygon& outline);

  const LineOfSightSheets& sheets_;
  const FaceTree& tree_;
  const Tracer& tracer_;
  BeamVisibility& visible_;
  BeamTree& beams_;
  std::vector<ScreenedPart> screened_;
};

/// For tubes of one ray each.
class RayLineOfSight {
 public:
  struct Line {
    std::uint32_t tube, node;
    Ray ray;
  };

  RayLineOfSight(const LineOfSightSheets& sheets, const Tracer& tracer) : sheets_(sheets), tracer_(tracer) {}

  /// A tube's currents at a point on a patch.
  void add(std::uint32_t tube, std::uint32_t node, const dvec3& point, std::uint32_t patch) {
    if (sheets_.may_cover(point)) lines_.push_back({tube, node, {point, sheets_.towards_receiver(point), patch}});
  }

  /// Calls meet(line) wherever a line meets anything, line.ray starting there, and forgets them all. Counts rays.
  template <class Meet>
  std::uint64_t follow(Meet meet);

  /// Calls visit(tube, node) for every sheet on the way of every line added, and forgets them. Counts rays.
  template <class Visit>
  std::uint64_t through_sheets(BeamTree& beams, Visit visit);

 private:
  void trace();

  const LineOfSightSheets& sheets_;
  const Tracer& tracer_;
  std::vector<Line> lines_;  // of those that trace() leaves the rays start where they met something
};

template <class Meet>
std::uint64_t RayLineOfSight::follow(Meet meet) {
  std::uint64_t rays = 0;
  while (!lines_.empty()) {
    rays += lines_.size();
    trace();
    for (Line& line : lines_) meet(line);
  }
  return rays;
}

template <class Visit>
std::uint64_t RayLineOfSight::through_sheets(BeamTree& beams, Visit visit) {
  return follow([&](Line& line) {
    if (!beams.is_sheet(line.ray.source_patch)) return;
    line.node = beams.through_screen(line.node, line.ray.source_patch);
    visit(line.tube, line.node);
  });
}

}  // namespace raytube
