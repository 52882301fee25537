// Pieces of edges along which the waves of antennas at a finite distance are plane.
#pragma once

#include <vector>

#include "mesh/features/wedges.h"
#include "utd/wedge/edge_currents.h"
#include "utd/wedge/image_antenna.h"

namespace raytube {

/// A piece of an edge [begin, end] in the waves of two antennas, both plane along it.
struct NearPiece {
  double begin, end;  // fractions of the edge
  dvec3 middle;
  LookVectors look;  // fields with their amplitudes
  double path;       // added to the phase that the plane waves of `look` have [m]
};

/// By how much waves of an antenna are not plane at most on a target of this radius about the origin, twice over [rad].
double bend_over_target(const Antenna& antenna, double wavenumber, double radius);

/// The waves of antennas where they meet an edge. What edges send on is not continuous where it runs exactly along another one.
/// Rays that are parallel over the whole target are therefore taken so: the limit of a long range is the far field.
class NearLook {
 public:
  NearLook(const NearAntennas& antennas, double wavenumber, double radius);

  LookVectors at(const dvec3& point) const;
  const NearAntennas& antennas() const { return antennas_; }

 private:
  NearAntennas antennas_;
  bool parallel_in_, parallel_out_;
};

/// Cuts edges into pieces along which the waves of both antennas are plane.
class PieceCutter {
 public:
  PieceCutter(const NearAntennas& antennas, double wavenumber, double radius)
      : near_(antennas, wavenumber, radius), wavenumber_(wavenumber) {}

  /// Halves the part [begin, end] of an edge until its pieces are short enough.
  void cut(const Wedge& wedge, double begin, double end, std::vector<NearPiece>& pieces) const;

 private:
  double path_over(const dvec3& point) const;

  NearLook near_;
  double wavenumber_;
};

}  // namespace raytube
