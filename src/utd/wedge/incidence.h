// How an incident plane wave meets a wedge: which faces it lights and at what angles.
#pragma once

#include "mesh/features/wedges.h"

namespace raytube {

/// The incident wave in the frame of one face (notation in edge_currents.h). The two faces of a wedge have opposite t.
struct FaceIncidence {
  dvec3 tangent;              // t
  double cos_cone = 0.0;      // cos(beta')
  double sin_cone = 0.0;      // sin(beta'), not below sin_cone_floor
  double source_angle = 0.0;  // phi' towards the source, from this face through free space, in [0, n pi] [rad]
  bool lit = false;           // U: phi' < pi
};

/// What a wedge receives, before any other surface casts a shadow.
struct WedgeIncidence {
  std::array<FaceIncidence, 2> faces;
  double weight = 0.0;   // 0 turned away, 1 exposed, 1/2 exactly grazed along the one face it arrives over
  dvec3 free_side{0.0};  // normal of that face when the weight is 1/2: the side from which the edge is seen; else 0
};

/// The least sin(beta0): every fringe current stays bounded where a wave comes along the edge, and its formula needs the floor.
inline constexpr double sin_cone_floor = 1e-6;

/// A face is lit when s' . n_f < -1e-7: closer to grazing its tubes have no width either.
inline constexpr double lit_threshold = 1e-7;

/// Where the two sides of a sheet without thickness meet: their currents are alike.
inline bool ends_sheet(const Wedge& wedge) { return wedge.is_border() && wedge.n == 2.0; }

/// `incident` is s', the unit propagation direction. Looks exactly along a face: a half plane met edge-on from its open side is
/// fully exposed, with both sides dark; an edge reached over a grazed face counts half, the mean of its lit and its hidden limit
/// (zero for a half plane, whose two limits are the opposite currents of its two sides). So results are finite everywhere and
/// continuous where the first-order theory is: all but the hard wave that arrives over a grazed face, whose limit depends on the
/// direction of approach. Valid for convex wedges, n > 1.
WedgeIncidence incidence_on(const Wedge& wedge, const dvec3& incident);

}  // namespace raytube
