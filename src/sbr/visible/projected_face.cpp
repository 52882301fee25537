#include "sbr/visible/projected_face.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

FaceProjector::FaceProjector(const FaceTree& tree)
    : tree_(tree),
      // Projected coordinates and crossings carry a few roundings of numbers up to the radius, heights of one plane over
      // another some tens.
      length_rounding_(16.0 * std::numeric_limits<double>::epsilon() * tree.mesh().radius),
      height_rounding_(64.0 * std::numeric_limits<double>::epsilon() * tree.mesh().radius) {}

bool FaceProjector::faces_beam(const BeamView& view, std::uint32_t face) const {
  const Face& f = tree_.faces()[face];
  const double side = facing(view.beam, tree_.mesh().patches[f.patch]);
  if (f.patch == view.source_patch || std::abs(side) < edge_on) return false;
  return side < 0.0 || !tree_.mesh().closed(f.triangle);
}

bool FaceProjector::project(const BeamView& view, std::uint32_t face, ProjectedFace& f) {
  if (!faces_beam(view, face)) return false;
  const Face& source = tree_.faces()[face];
  const Patch& plane = tree_.mesh().patches[source.patch];
  f.tilt = std::abs(facing(view.beam, plane));
  f.face = face, f.patch = source.patch, f.triangle = source.triangle;
  if (!set_outline(view, f)) return false;
  if (view.region && (separates(f.outline, *view.region) || !clip_to_region(f.outline))) return false;
  f.depth = depth_of(view.beam, plane);
  if (view.source) clip_to_front(view, f);
  if (f.outline.empty()) return false;
  f.box = bounds(f.outline);
  f.depths = range(f.outline, f.depth);
  return !is_sliver(f.outline);
}

// A spherical wave meets nothing nearer than the surface it leaves: what lies behind its source is cut off in between. All of the
// target lies before the receiver in which lines of sight meet.
void FaceProjector::project_corners(const BeamView& view, std::uint32_t face) {
  const Beam& beam = view.beam;
  const auto corners = tree_.points(face);
  corners_.clear();
  if (!beam.spherical()) {
    for (const dvec3& corner : corners) corners_.push_back(launch_coordinates(beam, corner));
    return;
  }
  const double nearest =
      view.source && beam.curvature > 0.0 ? 0.5 * widening_at(beam, range(*view.region, view.source_depth).low) : 0.0;
  dvec3 before = corners.back();
  double w_before = widening(beam, before) - nearest;
  for (const dvec3& r : corners) {
    const double w = widening(beam, r) - nearest;
    if ((w > 0.0) != (w_before > 0.0))
      corners_.push_back(launch_coordinates(beam, before + w_before / (w_before - w) * (r - before)));
    if (w > 0.0) corners_.push_back(launch_coordinates(beam, r));
    before = r, w_before = w;
  }
}

// False if the face lies beside the part of the view in question.
bool FaceProjector::set_outline(const BeamView& view, ProjectedFace& f) {
  project_corners(view, f.face);
  if (corners_.size() < 3) return false;
  Bounds box{corners_[0], corners_[0]};
  for (const dvec2& at : corners_) box = {glm::min(box.low, at), glm::max(box.high, at)};
  if (!box.overlaps(view.box, length_rounding_) || (view.region && lies_beside(*view.region))) return false;
  set_corners(f.outline, corners_);
  f.edges.clear();
  f.edges.reserve(f.outline.size() + 1);
  for (const Corner& corner : f.outline) f.edges.push_back(corner.edge);
  return true;
}

// Notes the region's edges that some of the corners lie beyond; true if they all lie beyond one.
bool FaceProjector::lies_beside(const ConvexPolygon& region) {
  crossed_.clear();
  for (const Corner& side : region) {
    Range r{side.edge(corners_[0]), side.edge(corners_[0])};
    for (const dvec2& corner : corners_) {
      r.low = std::min(r.low, side.edge(corner));
      r.high = std::max(r.high, side.edge(corner));
    }
    if (r.high <= length_rounding_) return true;
    if (r.low < -length_rounding_) crossed_.push_back(side.edge);
  }
  return false;
}

bool FaceProjector::clip_to_region(ConvexPolygon& outline) {
  for (const Affine& edge : crossed_) {
    clip(outline, edge, length_rounding_, inside_);
    std::swap(outline, inside_);
    if (outline.empty()) return false;
  }
  return true;
}

bool FaceProjector::separates(const ConvexPolygon& polygon, const ConvexPolygon& other) const {
  return std::ranges::any_of(polygon,
                             [&](const Corner& corner) { return !reaches_beyond(other, corner.edge, length_rounding_); });
}

// Only what lies ahead of the surface the beam leaves, by more than rounding, is met: see ExactHit::ahead.
void FaceProjector::clip_to_front(const BeamView& view, ProjectedFace& f) {
  const Affine ahead = f.depth - view.source_depth;
  const Range r = range(f.outline, ahead);
  if (r.high * std::min(f.tilt, view.source_tilt) <= height_rounding_) return f.outline.clear();
  if (r.low >= 0.0) return;
  clip(f.outline, ahead, 0.0, inside_);
  std::swap(f.outline, inside_);
  f.edges.push_back(normalized(ahead));
}

Affine FaceProjector::behind(const ProjectedFace& front, const ProjectedFace& f) const {
  const Affine by_index{front.triangle < f.triangle ? 1.0 : -1.0, 0.0, 0.0};
  if (front.patch == f.patch) return by_index;
  const Affine difference = f.depth - front.depth;
  const Range r = range(common(front.box, f.box), difference);
  const double depth_rounding = height_rounding_ / std::min(front.tilt, f.tilt);
  return r.high > depth_rounding || r.low < -depth_rounding ? difference : by_index;
}

bool FaceProjector::fills(const ProjectedFace& f, const ConvexPolygon& outline) const {
  return std::ranges::all_of(f.edges, [&](const Affine& edge) {
    return std::ranges::all_of(outline, [&](const Corner& corner) { return edge(corner.at) >= -length_rounding_; });
  });
}

bool FaceProjector::is_sliver(const ConvexPolygon& polygon) const {
  if (polygon.empty()) return true;
  const Bounds box = bounds(polygon);
  return area(polygon) <= length_rounding_ * glm::length(box.high - box.low);
}

}  // namespace raytube
