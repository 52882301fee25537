// What flat facets in place of curved surfaces, and surfaces guessed from few facets, do to physical optics.
#pragma once

#include <vector>

#include "mesh/features/wedges.h"
#include "mesh/smooth/smooth.h"
#include "scene/sweep.h"

namespace raytube {

/// Error of the amplitude that a chord of this dent [m] reflects, over that amplitude: the root mean square of the phase by which
/// a parabola stands off it, there and back, 8/15 being the mean of (1 - x^2)^2. Valid for dents below wavelength / 10.
double chord_error(double dent, double wavelength);

/// Creases up to twice as steep as `min_wedge_angle` may be tessellation, too [rad].
double doubtful_crease(double min_wedge_angle);

/// How far facets lie off the surface that they may stand for.
class FacetDents {
 public:
  /// `taken`: the curved surfaces that tubes see; null: all facets are flat. `meant`: those that facets may stand for, of creases
  /// up to doubtful_crease(). Keeps a reference to the mesh.
  FacetDents(const TriangleMesh& mesh, const SmoothSurfaces* taken, const SmoothSurfaces& meant);

  /// The error of the physical-optics amplitude of a look over that amplitude, 0 ... 2: that of the facets which are turned so
  /// that they reflect to the receiver. With s the dent of a chord and t its turning [rad], measured in two dimensions on circles
  /// and ellipses of even and uneven chords: flat 9.2 s / wavelength, up to 2; bent 0.31 t^{3/2} times that. Surfaces have two
  /// curvatures and triangles of any shape: 1.2 covers those of docs/theory/model_uncertainty.md.
  double relative_error(const Look& look, double frequency) const;

 private:
  struct Dent {
    double area = 0.0;   // [m^2]
    double depth = 0.0;  // mean over it of its depth below the surface that it may stand for beyond that of the one taken, and of
                         // the share of that one which is wrong [m]
  };
  const TriangleMesh& mesh_;
  std::vector<Dent> dents_;  // [patch], none where nothing is curved
};

/// Mean dent of the chords of rims: of wedges that go on in one another with less than twice `min_wedge_angle` [rad] of turning,
/// by length [m].
double rim_dent(std::span<const Wedge> wedges, double min_wedge_angle);

}  // namespace raytube
