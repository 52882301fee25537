// Edge-visibility: which parts of a wedge can be reached from a viewpoint, the transmitter or the receiver.
//
// Positions on a wedge are fractions of its length from wedge.start, 0 to 1. The parts are found in three steps:
//   crossings.h        where wedges of the target's silhouette pass in front: candidates for the ends of shadows
//   edge_visibility.h  rays from points between them; a change from lit to dark is confirmed at a candidate, or bisected
//   lit_edges.h        what transmitter and receiver have in common
#pragma once

#include <optional>
#include <vector>

#include "mesh/trace/tracer.h"
#include "utd/shadow/crossings.h"

namespace raytube {

/// A lit part of a wedge, as fractions of its length from wedge.start.
struct LitInterval {
  double begin;
  double end;
};

/// What rays from an edge go to: a direction, or a point in front of the target.
class Viewpoint {
 public:
  Viewpoint(const dvec3& direction) : vector_(direction) {}
  static Viewpoint at(const dvec3& position) {
    Viewpoint view(position);
    view.far_ = false;
    return view;
  }

  /// Unit vector towards it.
  dvec3 from(const dvec3& point) const { return far_ ? vector_ : glm::normalize(vector_ - point); }
  bool far() const { return far_; }

 private:
  dvec3 vector_;
  bool far_ = true;
};

/// Finds the parts of wedges that light from one viewpoint reaches. Keeps references to wedges and tracer.
class EdgeVisibility {
 public:
  /// `wavelength` [m] is the shortest of the look.
  EdgeVisibility(std::span<const Wedge> wedges, const Tracer& tracer, const Viewpoint& view, double wavelength);

  /// Fills `lit` (cleared first, capacity kept) with the parts of wedge `index` from which nothing but its own two patches lies
  /// on the way to the viewpoint, in order; `away` is the normal of a face along which the rays run, to start them off it, else
  /// 0. Test points stand at most half a wavelength apart, at least 8 and at most 128 of them from end to end, and one more
  /// between any two neighbouring crossings by wedges of the silhouette. Each change from lit to dark is at such a crossing,
  /// confirmed in double precision 1e-9 of the length to either side of it, or else bisected to 1e-13 of the length. So the
  /// shadow of a polygonal body is never missed, however narrow; that of a curved one, whose outline is no wedge, can be if it is
  /// narrower than the spacing. So can any shadow towards a point at a finite distance: there is no silhouette then, and changes
  /// are bisected.
  void find(std::uint32_t index, const dvec3& away, std::vector<LitInterval>& lit);

 private:
  std::span<const Wedge> wedges_;
  const Tracer& tracer_;
  Viewpoint view_;
  double wavelength_;
  std::optional<Crossings> crossings_;
  std::vector<Ray> rays_;
  std::vector<std::uint32_t> blockers_;
  std::vector<double> crossed_, points_;
};

}  // namespace raytube
