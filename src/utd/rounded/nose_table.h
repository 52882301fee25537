// Modes of noses, as they are asked for.
#pragma once

#include <array>
#include <mutex>
#include <optional>

#include "utd/rounded/conic_section.h"
#include "utd/rounded/rounded_wedge.h"

namespace raytube {

/// A nose with k rho and e of a node of the table, cut where k times its radius is `edge_radius` and its flanks begin.
struct NoseNode {
  ConicSection section;  // at k = 1
  RoundedWedge modes;
};

/// Nodes in ln(k rho) and e around what is asked, with their weights; what they make of a wave is
/// interpolated, not they.
struct NosePlace {
  const NoseNode* node;  // none: nothing is rounded any more
  double weight;
};

std::array<NosePlace, 4> nose_places(double wavenumber_radius, double flattening);

}  // namespace raytube
