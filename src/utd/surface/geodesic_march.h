// A strip along a geodesic of a curved surface: how far it has come, how wide it is, how much it has bent.
#pragma once

#include "utd/fock/fock.h"
#include "utd/surface/curved_target.h"
#include "utd/surface/strip_width.h"
#include "utd/surface/surface_ray.h"

namespace raytube {

/// Marches over facets to any distance that is asked for. The surface is asked for its curvature there, and on the way so often
/// that it is known every `sampling` metres or once a facet. Keeps a reference to the target.
class GeodesicMarch {
 public:
  /// From a point into a direction; `side` as for CurvedTarget::frame. The strip has the width `begin` there. At a tip the
  /// curvature tells nothing of what follows: the first step has that of its end.
  GeodesicMarch(const CurvedTarget& target, const FacetPoint& start, const dvec3& direction, double side, double sampling,
                const StripWidth& begin = {1.0}, bool at_tip = false);

  /// On to a distance from the start [m], not less than where it stands. False if the surface ends before, then it stands at the
  /// end, or if the strip has been lost: it is many times as wide as at its start, next to a focus of geodesics it has left.
  bool march_to(double distance);

  double distance() const { return known_; }
  dvec3 position() const;
  const dvec3& normal() const { return normal_; }
  const dvec3& direction() const { return direction_; }  // tangential there
  const StripWidth& width() const { return width_; }
  double curvature() const { return curvature_; }  // normal, along the strip [1/m]
  /// Where the surface bends away.
  const DarkWay& way() const { return way_; }

  bool lost() const;
  std::uint32_t triangle() const { return piece_.from.triangle; }
  /// As Geodesic::ended_at().
  int ended_at() const { return geodesic_.ended_at(); }

 private:
  bool next_piece();
  void stand_at(const dvec2& l, double distance);

  const CurvedTarget& target_;
  double side_, sampling_;
  Geodesic geodesic_;
  GeodesicPiece piece_;
  dvec2 at_;                                    // barycentric coordinates in the piece's facet
  double piece_start_ = 0.0, piece_end_ = 0.0;  // of the piece [m]
  double known_ = 0.0;
  double curvature_ = 0.0, gaussian_ = 0.0, widest_;
  bool at_tip_;
  StripWidth width_;
  DarkWay way_;
  dvec3 direction_{0.0}, normal_{0.0};
};

}  // namespace raytube
