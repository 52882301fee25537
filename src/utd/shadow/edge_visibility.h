// Edge-visibility: which parts of a wedge can be reached from a viewpoint, the transmitter or the receiver.
//
// Positions on a wedge are fractions of its length from wedge.start, 0 to 1. The parts are found in three steps:
//   crossings.h        where wedges of the target's silhouette pass in front: shadows may begin and end there
//   edge_visibility.h  rays from points between them, but for points that a triangle found in the way of others hides, too; from
//                      lit to dark along the shadows of single triangles (triangle_shadow.h)
//   lit_edges.h        what transmitter and receiver have in common
#pragma once

#include <optional>
#include <vector>

#include "mesh/trace/tracer.h"
#include "utd/shadow/crossings.h"
#include "utd/shadow/viewpoint.h"

namespace raytube {

/// A lit part of a wedge, as fractions of its length from wedge.start.
struct LitInterval {
  double begin;
  double end;
};

/// Finds the parts of wedges that light from one viewpoint reaches. Keeps references to wedges and tracer.
class EdgeVisibility {
 public:
  /// `wavelength` [m] is the shortest of the look.
  EdgeVisibility(std::span<const Wedge> wedges, const Tracer& tracer, const Viewpoint& view, double wavelength);

  /// Fills `lit` (cleared first, capacity kept) with the parts of wedge `index` from which nothing but its own two patches lies
  /// on the way to the viewpoint, in order; `away` is the normal of a face along which the rays run, to start them off it, else
  /// 0. Test points stand at most half a wavelength apart, at least 8 and at most 128 of them from end to end, and one more
  /// between any two neighbouring crossings by wedges of the silhouette. Each change from lit to dark is where the shadow of a
  /// triangle ends, confirmed in double precision 1e-9 of the length beyond, or else bisected to 1e-13 of the length. So the
  /// shadow of a polygonal body is never missed, however narrow; that of a curved one, whose outline is no wedge, can be if it is
  /// narrower than the spacing. So can any shadow towards a point at a finite distance: there is no silhouette then.
  void find(std::uint32_t index, const dvec3& away, std::vector<LitInterval>& lit);

 private:
  struct Probe;
  void test_points(const Probe& probe);
  void drop_hidden(const Probe& probe, std::uint32_t blocker);

  std::span<const Wedge> wedges_;
  const Tracer& tracer_;
  Viewpoint view_;
  double wavelength_;
  std::optional<Crossings> crossings_;
  std::vector<double> crossed_, points_;
  std::vector<std::uint32_t> hidden_by_;  // [point], a triangle; no_index: it is lit
  std::vector<std::uint32_t> waiting_;    // points that are not known to be either
  std::vector<Ray> rays_;
  std::vector<std::uint32_t> found_;
  std::uint32_t last_blocker_ = no_index;  // neighbours are often behind the same triangle
};

}  // namespace raytube
