// Which parts of a wedge the transmitter sees.
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

/// Where one looks to from an edge: along a direction, or at a place in front of the target.
class Viewpoint {
 public:
  Viewpoint(const dvec3& direction) : vector_(direction) {}
  static Viewpoint at(const dvec3& place) {
    Viewpoint view(place);
    view.far_ = false;
    return view;
  }

  dvec3 from(const dvec3& point) const { return far_ ? vector_ : glm::normalize(vector_ - point); }
  bool far() const { return far_; }

 private:
  dvec3 vector_;
  bool far_ = true;
};

/// Finds the lit parts of wedges as seen from one viewpoint.
class Visibility {
 public:
  Visibility(std::span<const Wedge> wedges, const Tracer& tracer, const Viewpoint& view, double wavelength);

  /// Fills `lit` (cleared first, capacity kept) with the parts of wedge `index` from which nothing but its own two patches lies
  /// on the way to the viewpoint; `away` is the normal of a face along which the rays run, to start them off it, else 0. Test
  /// points stand at most half a wavelength apart, at least 8 and at most 128 of them from end to end, and one more between any
  /// two neighbours among the places where a wedge of the silhouette passes in front. Each change from one to the next is at such
  /// a place, confirmed in double precision a hair to either side of it, or else bisected to 1e-13 of the length. So the shadow
  /// of a polygonal body is never missed, however narrow; that of a curved one, whose outline is no wedge, can be if it is
  /// narrower than the spacing. So can any towards a place: there is no silhouette then, and changes are bisected.
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
