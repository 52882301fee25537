// A face as a beam meets it: a polygon of the launch plane with a depth.
#pragma once

#include "mesh/model/face_tree.h"
#include "sbr/beams/beam.h"
#include "sbr/launch/convex_polygon.h"

namespace raytube {

/// The beam that faces are projected along, and which part of it is in question.
struct BeamView {
  const Beam& beam;
  std::uint32_t source_patch;   // the patch the beam leaves; no_index: none
  const Patch* source;          // its plane; null: none
  Affine source_depth;          // along the beam
  double source_tilt;           // |facing| of the source
  const ConvexPolygon* region;  // the part of the beam in question; null: all of it
  Bounds box;                   // only what reaches into it is of interest
};

/// Along a beam closer to its own plane than this (|facing|), a face has no area: as for edges (lit_threshold), and beyond what
/// the rounding of coordinates far from their origin turns it by (1e-10 m at 1000 km).
inline constexpr double edge_on = 1e-7;

struct ProjectedFace {
  std::uint32_t face, patch, triangle;
  ConvexPolygon outline;      // within the region
  std::vector<Affine> edges;  // of the face itself, without those of the region
  Bounds box;
  Affine depth;
  Range depths;
  double tilt;  // |facing|: turns a difference of depth into a height over the plane
};

/// Projects faces and compares them, all to within the rounding of the mesh's coordinates. Keeps buffers between calls.
class FaceProjector {
 public:
  explicit FaceProjector(const FaceTree& tree);

  /// True if the beam can meet this face: another patch than the one it leaves, not edge-on, a closed body from outside.
  bool faces_beam(const BeamView& view, std::uint32_t face) const;

  /// Fills `f`; false if the beam meets none of the face within the region.
  bool project(const BeamView& view, std::uint32_t face, ProjectedFace& f);

  /// How far `f` lies behind `front`, positive where that one is nearer. Two planes that coincide, and two faces of one patch,
  /// are ordered by their triangles, over all their common box alike.
  Affine behind(const ProjectedFace& front, const ProjectedFace& f) const;

  /// One of the polygon's edges has the other one on its far side.
  bool separates(const ConvexPolygon& polygon, const ConvexPolygon& other) const;
  /// Not one corner of the outline lies outside the face.
  bool fills(const ProjectedFace& f, const ConvexPolygon& outline) const;
  bool is_sliver(const ConvexPolygon& polygon) const;

  double length_rounding() const { return length_rounding_; }

 private:
  void project_corners(const BeamView& view, std::uint32_t face);
  bool set_outline(const BeamView& view, ProjectedFace& f);
  bool lies_beside(const ConvexPolygon& region);
  bool clip_to_region(ConvexPolygon& outline);
  void clip_to_front(const BeamView& view, ProjectedFace& f);

  const FaceTree& tree_;
  double length_rounding_, height_rounding_;
  std::vector<dvec2> corners_;
  std::vector<Affine> crossed_;  // edges of the region
  ConvexPolygon inside_;
};

}  // namespace raytube
