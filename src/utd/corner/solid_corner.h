// The corner of a conducting solid where three plane faces meet, exactly: what a plane wave sends along one of its edges.
#pragma once

#include <array>
#include <vector>

#include "core/complex_vector.h"
#include "utd/corner/radial_basis.h"

namespace raytube {

/// Its shape as one of its edges has it: the angles of the two faces beside that, each to the face's other edge, and of the metal
/// between them [rad]. Mirror images have the same shape.
struct SolidCornerShape {
  double first, second, metal;
  bool operator==(const SolidCornerShape&) const = default;
  double n() const { return 2.0 - metal / pi; }  // exterior angle of the edge / pi
};

/// The edge runs along +x from the tip at the origin, the first face into +y and the metal from there towards +z.
///
/// As SheetCorner, but the two scalar problems on the sphere are those outside a triangle: densities on its three sides, as
/// Nystroem's method finds them at points that crowd at the ends (Kress 1990, Numer. Math. 58, 145). Near the edge the wave's
/// field is E = (lambda / j) Gamma d^(1/n - 1) tau e^(-jkr) / r of a unit incident wave, d the angle from the edge, tau =
/// sin(chi / n) d^ + cos(chi / n) chi^, chi the angle about it from the first face through free space; Gamma is what the
/// potentials have of the first harmonic in chi on a circle about the edge, over its radial function. docs/theory/corners.md.
class SolidCorner {
 public:
  explicit SolidCorner(const SolidCornerShape& shape);

  /// G, with which Gamma = p . G of an incident wave from the direction of the unit vector `towards`, polarised along p, or by
  /// reciprocity of a receiver there. Within 20 degrees of the edge it is that at 20 degrees; none from inside the metal.
  ComplexVector start(const dvec3& towards) const;

  /// The memory of one corner.
  static std::size_t bytes();

 private:
  struct Sides;

  /// Unit sources of the two potentials on a side of the triangle, with what they send along the edge.
  struct Source {
    dvec3 point, normal;
    double spacing;  // between it and the next one [rad]
    RadialSum soft, hard;
  };
  /// What a source without a solid sends there over a point of the circle.
  struct Crossing {
    dvec3 point;
    RadialSum soft, hard;
  };
  struct Gradients {
    ComplexVector soft, hard;
  };
  struct Raised {
    dvec3 towards, along;
    double height;  // height of the direction above the face, over that of `towards`
  };
  Gradients gradients(const dvec3& towards) const;
  Raised raised(const dvec3& source) const;

  std::array<dvec3, 3> normals_;
  std::vector<Source> sources_;
  std::vector<Crossing> crossings_;
};

}  // namespace raytube
