// The corner of a plane conducting sheet, exactly: what a plane wave that meets it sends along one of its two edges.
#pragma once

#include <vector>

#include "core/complex_vector.h"
#include "utd/corner/radial_basis.h"

namespace raytube {

/// A sector of the plane z = 0 with its tip at the origin and the bisector of its angle along +x; the wave is the one along the
/// edge at +y.
///
/// The field of a cone follows from two scalar problems on the unit sphere, one for each Debye potential: with Dirichlet's
/// condition on the sector's arc, and with Neumann's (Smyshlyaev 1993, Wave Motion 18, 171; Babich, Smyshlyaev, Dement'ev &
/// Samokish 2000, IMA J. Appl. Math. 65, 123). Both are integral equations on the arc, solved at some 100 orders nu. A Gaussian
/// exp(-(nu / 6)^2) in nu, which is k times the moment arm of what happens at a point, takes the neighbourhood of the tip: it
/// leaves directions alone that lie 1/6 rad and more off those into which the edges diffract, and keeps the others finite.
///
/// Near the edge, at the angle d from it, the wave's field is E = (lambda / j) Gamma d^(-1/2) tau e^(-jkr) / r of a unit incident
/// wave, tau = -sin(chi / 2) u + cos(chi / 2) z; u points from the edge into the sheet, chi is measured from it.
/// docs/theory/corners.md.
class SheetCorner {
 public:
  /// 15 to 165 degrees: `angle` in rad.
  explicit SheetCorner(double angle);

  /// G, with which Gamma = p . G of an incident wave from some direction, polarised along p, or by reciprocity of a receiver
  /// there: the part along the sheet's plane and the one upright on it.
  struct Start {
    ComplexVector flat, upright;
  };
  /// What a wave from the direction of the unit vector `towards` starts. Closer to the sheet than 3 degrees, at a right angle, it
  /// is interpolated between there and the sheet itself.
  Start start(const dvec3& towards) const;

  /// The memory of one corner.
  static std::size_t bytes();

 private:
  struct Arc;

  struct Source {
    dvec3 point;
    RadialSum soft, hard;  // those of unit sources of the two potentials, with what they send along the edge
  };
  struct Gradients {
    ComplexVector soft, hard;
  };
  Gradients gradients(const dvec3& towards) const;
  double nearest_height(const dvec3& towards) const;

  double half_angle_;
  std::vector<Source> sources_;
};

}  // namespace raytube
