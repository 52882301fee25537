// What the size of a target allows each mechanism, and the rows in which one exceeds it: a program that gives such a row in
// silence cannot be trusted with any.
//
// Bounds of |S_pq| [m], wavenumber k, for unit incident fields. Derived in docs/theory/bounds.md:
//   one bounce, monostatic    k / (2 pi) A_p: the currents 2 n x H on what the wave meets, whose projected area is A_p
//   any other bounce          k / (2 pi) A: as much current on all of the surface A
//   edges, order 1            L + k / (2 pi) A of bistatic looks: on either side of every edge, of length L in all, twice the
//                             incident field over half a wavelength; in forward directions the shadow of the faces
//   edges, orders 2, 3        as much again for every further edge in a row
//   waves on curved surfaces  k / (2 pi) A: no current there is stronger than on a plane
//   edges on other faces      k / (2 pi) A: what an edge diffracts is nowhere stronger than what it receives
#pragma once

#include <vector>

#include "plan/plan.h"

namespace raytube {

/// The bounds of one row [m].
struct PhysicalBound {
  double first_bounce, later_bounces;
  AmplitudeLimits limits;  // of the mechanisms
};

/// Of a target and a sweep. Keeps a reference to the plan.
class PhysicalBounds {
 public:
  /// `edge_lengths`: of the edges that add to S, all in all, per frequency [m] (LookSolver::edge_lengths).
  PhysicalBounds(const SolvePlan& plan, std::vector<double> edge_lengths);

  PhysicalBound of(const Look& look, std::size_t frequency_index) const;

 private:
  double projected_area(const dvec3& direction) const;

  const SolvePlan& plan_;
  std::vector<double> edge_lengths_;
  double surface_;  // exposed, both sides where both are [m^2]
  dvec3 box_;       // edges of the target's bounding box [m]
};

}  // namespace raytube
