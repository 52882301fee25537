// Fringe current of one strip of a face, from the edge to the place where the face ends: integrals in closed form.
// Derived in docs/edges.md. Exact on a half plane; on a wedge the current is the uniform (Kouyoumjian-Pathak) one for the
// length of the strip, and what that lacks close to the edge is added as if the strip went on to infinity.
// In formulas: xi = k sin(beta') x, x the distance across the face; X = xi at the end; h = cos(g/2) = |s - sigma|/(2 sin beta').
#pragma once

#include <array>

#include "utd/edge_currents.h"

namespace raytube {

/// One strip: integrals over the fringe current for unit E or eta H along the edge, as FringeKernels are for an endless one,
/// and the current that arrives at the end.
struct StripKernels {
  FringeKernels current;
  Complex end_phase;  // e^{jX(mu - 1)}: phase of what radiates from the end, relative to the start
  Complex arriving;   // H_fr(X) e^{jX} / 2: the hard fringe current at the end, without the phase of the way there
};

/// Everything about a strip but its electrical length.
class Strip {
 public:
  Strip(double n, FaceIncidence incidence, double half_cosine);

  /// `length` is X; infinity gives the kernels of the endless strip.
  StripKernels at(double length) const;

 private:
  /// A diffracted wave on the face: B e^{j xi cos(beta)} erfc(e^{j pi/4} sqrt(2 xi) c), c = |cos(beta/2)|.
  struct Term {
    double strength;  // B
    double distance;  // c, 0 on the boundary of the incident or reflected wave
    double slope;     // dc/dphi'
  };
  static Term term(double n, double source, int sign);
  void add_local_part(double n, const FaceIncidence& incidence);
  StripKernels endless() const;

  std::array<Term, 2> terms_{};
  int term_count_ = 2;
  double half_cosine_;
  FringeKernels local_{};  // exact minus uniform current of the endless strip
};

}  // namespace raytube
