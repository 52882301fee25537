// Pieces of edges along which the waves of antennas at a finite distance are plane.
#pragma once

#include <vector>

#include "mesh/features/wedges.h"
#include "utd/wedge/near_look.h"

namespace raytube {

/// A piece of an edge [begin, end] in the waves of two antennas, both plane along it.
struct NearPiece {
  double begin, end;  // fractions of the edge
  dvec3 middle;
  LookVectors look;  // fields with their amplitudes
  double path;       // added to the phase that the plane waves of `look` have [m]
};

/// Cuts edges into pieces along which the waves of both antennas are plane.
class PieceCutter {
 public:
  PieceCutter(const NearAntennas& antennas, double wavenumber, double radius)
      : PieceCutter(NearLook(antennas, wavenumber, radius), wavenumber) {}
  PieceCutter(const NearLook& near, double wavenumber) : near_(near), wavenumber_(wavenumber) {}

  /// Halves the part [begin, end] of an edge until its pieces are short enough.
  void cut(const Wedge& wedge, double begin, double end, std::vector<NearPiece>& pieces) const;

 private:
  NearLook near_;
  double wavenumber_;
};

}  // namespace raytube
