// Beam visibility: which surfaces a beam meets first, and where, by exact hidden-surface removal in the launch plane.
//
// The central header of this folder: faces as a beam meets them (projected_face), what is left of them once others stand in front
// (beam_visibility), and the receiver's own beam, which looks back through sheets (line_of_sight). Depth is counted along the
// beam [m]; a face's depth is affine in the launch coordinates, so the order of two faces is the sign of an affine function.
#pragma once

#include <deque>
#include <unordered_map>

#include "mesh/model/face_tree.h"
#include "mesh/trace/tracer.h"
#include "sbr/visible/projected_face.h"

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
class BeamVisibility {
 public:
  BeamVisibility(const FaceTree& tree, const Tracer& tracer);

  /// Appends the parts of these faces that an incident wave reaches.
  void of_faces(const Beam& incident, std::span<const std::uint32_t> faces, std::vector<VisiblePart>& parts);

  /// Appends these faces as an incident wave reaches them where none shadows another: each as a whole.
  void of_whole_faces(const Beam& incident, std::span<const std::uint32_t> faces, std::vector<VisiblePart>& parts);

  /// Appends what the part `region` of a beam that leaves `source_patch` meets. `in_middle` is what its middle_ray meets: it
  /// bounds the search and never decides.
  void from_surface(const Beam& beam, std::uint32_t source_patch, const ConvexPolygon& region, const Hit& in_middle,
                    std::vector<VisiblePart>& parts);

  /// Appends what an incident wave reaches within `region`.
  void within(const Beam& incident, const ConvexPolygon& region, std::vector<VisiblePart>& parts);

  /// The ray of the middle of `region`.
  Ray middle_ray(const Beam& beam, std::uint32_t source_patch, const ConvexPolygon& region) const;

  /// Area of pieces too thin to be more than rounding, left out so far [m^2].
  double sliver_area() const { return sliver_area_; }
  /// Counts it from zero again.
  void restart() { sliver_area_ = 0.0; }

 private:
  // Projected faces, kept with their memory, each where it is.
  struct Pool {
    std::deque<ProjectedFace> items;
    std::size_t count = 0;
    ProjectedFace& next() {
      if (count == items.size()) items.emplace_back();
      return items[count];
    }
  };
  // A face that may hide the one in question, and how far that one lies behind it [m].
  struct Occluder {
    const ProjectedFace* face;
    Affine behind;
  };

  void meet(const BeamView& view, double farthest, std::vector<VisiblePart>& parts);
  void drop_hidden(const BeamView& view);
  void uncover_in_groups(const BeamView& view, std::vector<VisiblePart>& parts);
  void uncover_group(const BeamView& view, std::span<const ProjectedFace* const> faces, std::vector<VisiblePart>& parts);
  void gather(const BeamView& view, std::span<const std::uint32_t> faces, Pool& pool);
  void gather_nearest_first(const BeamView& view, double farthest);
  const ProjectedFace* projected(const BeamView& view, std::uint32_t face);
  void uncover_in_view(std::vector<VisiblePart>& parts);
  void uncover(const ProjectedFace& c, std::vector<VisiblePart>& parts);
  void uncover(const ProjectedFace& c, const ConvexPolygon& outline, std::size_t begin, std::size_t end, std::size_t before,
               int tries, std::vector<VisiblePart>& parts);
  void halve(const ProjectedFace& c, const ConvexPolygon& outline, std::size_t begin, std::size_t end, int tries,
             std::vector<VisiblePart>& parts);
  bool hides_all(const Occluder& front, const ConvexPolygon& outline) const;
  void subtract(const Occluder& front);
  bool subtract(const ProjectedFace& front, const Affine& order, const ConvexPolygon& piece);
  void emit(const ProjectedFace& c, const ConvexPolygon& piece, std::vector<VisiblePart>& parts);

  const FaceTree& tree_;
  const Tracer& tracer_;
  FaceProjector projector_;
  double depth_margin_;  // so that no surface coincident with the one in question is missed
  double sliver_area_ = 0.0;
  Pool in_view_, in_front_;
  ProjectedFace first_;
  std::vector<const ProjectedFace*> waiting_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::vector<std::uint32_t> found_, found_in_front_;
  std::unordered_map<std::uint32_t, const ProjectedFace*> projected_;  // faces asked about, and what in_front_ has of them
  std::vector<const ProjectedFace*> others_;                           // faces that may hide the ones in question
  std::vector<Occluder> occluders_;  // of the face in question and of its parts, one list after the other
  std::vector<ConvexPolygon> pieces_, remaining_;
  std::vector<std::pair<double, std::uint32_t>> by_depth_;
  ConvexPolygon inside_, outside_, rest_;
};

}  // namespace raytube
