// Which surfaces a beam meets first, and where: exact hidden-surface removal in the launch plane.
#pragma once

#include "mesh/face_tree.h"
#include "mesh/tracer.h"
#include "sbr/convex_polygon.h"
#include "sbr/footprint.h"

namespace raytube {

/// A part of a face that the beam reaches before anything else.
struct VisiblePart {
  std::uint32_t face;
  ConvexPolygon outline;  // in launch coordinates
};

/// Under planar reflections the launch plane maps affinely onto every surface a beam meets, so each face is a convex polygon
/// there, its depth along the beam is affine, and what the other faces leave of it is a set of convex polygons. The nearest
/// surface counts, the lower triangle where two coincide. The patch a beam leaves, and what does not rise above its plane, is not
/// met. Closed bodies are met from outside only. Keeps buffers between calls: one object a thread.
class VisibleSurfaces {
 public:
  VisibleSurfaces(const FaceTree& tree, const Tracer& tracer);

  /// Appends what an incident wave sees of the faces [begin, end).
  void of_faces(const Beam& incident, std::uint32_t begin, std::uint32_t end, std::vector<VisiblePart>& parts);

  /// Appends what the part `region` of a beam that leaves `source_patch` meets. `in_middle` is what its middle_ray meets: a
  /// help, never the answer.
  void from_surface(const Beam& beam, std::uint32_t source_patch, const ConvexPolygon& region, const Hit& in_middle,
                    std::vector<VisiblePart>& parts);
  static Ray middle_ray(const Beam& beam, std::uint32_t source_patch, const ConvexPolygon& region);

  /// Area of pieces too thin to be more than rounding, left out so far [m^2].
  double sliver_area() const { return sliver_area_; }

 private:
  // A face as the beam sees it, within the region.
  struct Candidate {
    std::uint32_t face, patch, triangle;
    ConvexPolygon outline;
    std::vector<Affine> edges;  // of the face itself, without those of the region
    Bounds box;
    Affine depth;
    Range depths;
    double tilt;  // |normal . direction|: turns a difference of depth into a height over the plane
  };
  // Candidates kept with their memory.
  struct Pool {
    std::vector<Candidate> items;
    std::size_t count = 0;
    Candidate& next() {
      if (count == items.size()) items.emplace_back();
      return items[count];
    }
    std::span<const Candidate> used() const { return {items.data(), count}; }
  };
  // For whom candidates are sought.
  struct View {
    const Beam& beam;
    std::uint32_t source_patch;
    const ConvexPolygon* region;
    const Patch* source;
    Affine source_depth;
    double source_tilt;  // |normal . direction|
    Bounds box;          // only what reaches into it is of interest
  };

  void drop_hidden(const View& view);
  void see_in_groups(const View& view, std::vector<VisiblePart>& parts);
  void see(const View& view, std::span<const Candidate* const> faces, std::vector<VisiblePart>& parts);
  void gather(const View& view, std::span<const std::uint32_t> faces, Pool& pool);
  void gather_nearest_first(const View& view, double farthest);
  bool faces_beam(const View& view, std::uint32_t face) const;
  bool make_candidate(const View& view, std::uint32_t face, Candidate& c);
  bool project(const View& view, std::uint32_t face, Candidate& c);
  bool clip_to_region(const ConvexPolygon& region, ConvexPolygon& outline);
  void clip_to_front(const View& view, Candidate& c);
  void uncover(const Pool& candidates, const Pool& others, std::vector<VisiblePart>& parts);
  void uncover(const Candidate& c, const ConvexPolygon& outline, std::size_t begin, std::size_t end,
               std::vector<VisiblePart>& parts);
  void halve(const Candidate& c, const ConvexPolygon& outline, std::size_t begin, std::size_t end,
             std::vector<VisiblePart>& parts);
  bool may_hide(const Candidate& front, const Candidate& c, const Bounds& box) const;
  bool separates(const ConvexPolygon& polygon, const ConvexPolygon& other) const;
  Affine behind(const Candidate& front, const Candidate& c) const;
  bool fills(const Candidate& c, const ConvexPolygon& region) const;
  bool hides_all(const Candidate& front, const Candidate& c, const ConvexPolygon& outline) const;
  void subtract(const Candidate& front, const Candidate& c);
  bool subtract(const Candidate& front, const Affine& order, const ConvexPolygon& piece);
  bool is_sliver(const ConvexPolygon& polygon) const;
  void emit(const Candidate& c, const ConvexPolygon& piece, std::vector<VisiblePart>& parts);

  const FaceTree& tree_;
  const Tracer& tracer_;
  double length_rounding_, height_rounding_;
  double depth_margin_;  // so that no surface coincident with the one in question is missed
  double sliver_area_ = 0.0;
  Pool in_view_, in_front_;
  Candidate first_;
  std::vector<const Candidate*> waiting_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::vector<std::uint32_t> found_, found_in_front_;
  std::vector<const Candidate*> others_;  // who may hide what, one list after the other
  std::vector<ConvexPolygon> pieces_, remaining_;
  std::vector<std::pair<double, std::uint32_t>> by_depth_;
  std::vector<dvec2> corners_;
  ConvexPolygon inside_, outside_, rest_;
};

}  // namespace raytube
