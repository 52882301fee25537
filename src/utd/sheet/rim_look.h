// One look at one rim. Notation in sheet_admittance.h.
#pragma once

#include <algorithm>
#include <cmath>

#include "utd/sheet/sheet_half_plane.h"
#include "utd/wedge/edge_currents.h"

namespace raytube {

/// Curl and divergence of a wave along the sheet's normal are not apart: a cosine that is not 0 where b is. The moments are taken
/// that little aside.
inline double apart_from_normal(double cosine, double b) {
  constexpr double least = 1e-5;
  return std::hypot(cosine, b) < least ? least : cosine;
}

/// From the side of a plate that `face` is.
struct RimLook {
  dvec3 into_face, tangent;
  double sin_cone, b;
  double nu;  // towards the observer, times sin_cone

  RimLook(const WedgeFace& face, const FaceIncidence& incidence, const dvec3& scattered)
      : into_face(face.into_face),
        tangent(incidence.tangent),
        sin_cone(std::max(incidence.sin_cone, sin_cone_floor)),
        b(-incidence.cos_cone) {
    const double h = grazing_half_cosine(face, incidence, scattered);
    nu = apart_from_normal(sin_cone * (1 - 2 * h * h), b);
  }

  SheetVector in_sheet(const dvec3& field) const { return {glm::dot(field, into_face), glm::dot(field, tangent)}; }
};

/// S per length of rim, per receive polarisation.
using Received = std::array<Complex, 2>;

/// What the receiver has of a moment: -(j / 4 pi) p . J, and of magnetic currents (j / 4 pi) p . (s x M).
Received received(const SheetVector& moment, const RimLook& rim, const LookVectors& look, bool electric);

/// Tangential to a sheet in the frame of its rim: the field of a unit incident wave that drives its current.
inline SheetVector driving_field(const RimLook& rim, const LookVectors& look, bool electric, int transmit) {
  return rim.in_sheet(electric ? look.electric[transmit] : look.magnetic[transmit]);
}

}  // namespace raytube
