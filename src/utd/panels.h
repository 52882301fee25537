// Points along an edge for the integral over its strips.
#pragma once

#include <span>
#include <vector>

#include "mesh/outlines.h"
#include "utd/visibility.h"

namespace raytube {

struct EdgePoint {
  dvec3 place;
  double weight;  // [m]; the weights of a lit piece add up to its length
};

/// The strips of one wedge face, and how their contributions turn in phase, for the shortest wavelength of a look.
struct StripField {
  const Wedge& wedge;
  std::uint32_t wedge_index;
  int face;
  dvec3 direction;     // sigma
  dvec3 turning;       // s - s': path per distance along the edge
  double end_turning;  // s . sigma - 1: path per length of a strip
  double wavelength;
};

/// Fills `points` (cleared first) for the lit pieces of an edge. The face's corners, projected back on the edge along the strips,
/// cut it into panels on which the strips' lengths are linear; each panel has its Gauss rule, finer the longer it is and the
/// longer the far edge it sweeps. `breaks` is scratch.
void place_points(const StripField& field, const Outlines& outlines, std::span<const LitInterval> lit,
                  std::vector<double>& breaks, std::vector<EdgePoint>& points);

}  // namespace raytube
