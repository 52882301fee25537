// Modes that an edge of any section makes of those of its wedge, from the exact solution with endless faces.
#pragma once

#include <functional>
#include <vector>

#include "core/field.h"

namespace raytube {

/// T of the modes m = 0 to size - 1, m = 0 normalised; symmetric. That of m = 0 is zero for soft waves.
struct ModeMatrix {
  explicit ModeMatrix(std::size_t count) : size(count), values(count * count) {}
  Complex& at(std::size_t m, std::size_t q) { return values[m * size + q]; }
  Complex at(std::size_t m, std::size_t q) const { return values[m * size + q]; }

  std::size_t size;
  std::vector<Complex> values;
};

struct SoftHardModes {
  ModeMatrix soft, hard;
};

/// A point of a section, in the plane across the edge: the virtual apex is the origin, face 0 the positive x axis; lengths times
/// k.
struct SectionPoint {
  dvec2 position, slope, bend;  // and its derivatives by the parameter
};

/// From face 1 (at 0) to face 0 (at 1), tangent to both.
using Section = std::function<SectionPoint(double parameter)>;

/// Beyond the circle through the ends of the section, at `tangent_distance` kt from the virtual apex, the field is a sum of
/// modes; within it Green's identity holds over the circle and the section (Nystrom's method: Kress 1991, J. Comput. Appl. Math.
/// 61, 345), which least squares solve for the current on the section and the outgoing modes. Error 1e-5 of S per length or
/// below for alpha above 25 degrees, from modes left out; the unknowns grow as kt, the time (0.1 s at kt = 2) as its third power.
SoftHardModes section_modes(const Section& section, double interior_angle, double tangent_distance);

/// The arc tangent to both faces there.
Section arc_section(double interior_angle, double tangent_distance);

}  // namespace raytube
