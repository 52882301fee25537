// A strip as a row of points, over a face of any shape. Notation in multiple_diffraction.h.
#pragma once

#include <array>
#include <vector>

#include "utd/multiple/strip_layout.h"

namespace raytube {

/// A point of a strip.
struct StripNode {
  dvec3 position;
  double root;                          // root of the distance s from its edge [m^(1/2)]
  double path;                          // s . (r - r_0) less that distance [m]
  double bend;                          // xi k^(-1/3) [m^(1/3)]
  double area;                          // root of the width over that at the edge
  int caustics;                         // passed
  std::array<double, 2> across, along;  // as FaceProjection
};

/// A strip from one point of an edge, and those that it starts where it ends.
struct StripPath {
  StripWave wave;
  dvec3 start;
  Strip strip;
  FaceProjection projection;     // at its edge
  std::vector<StripNode> nodes;  // none on a flat face
  double length = 0.0;           // [m]; infinite if it is taken as semi-infinite
  dvec3 end{0.0};
  double per_length = 0.0;      // s . sigma - 1 on a flat face
  std::vector<StripPath> next;  // on both faces of the wedge at its end

  /// The path of what radiates from its end, less that of its start [m].
  double end_path() const { return nodes.empty() ? per_length * length : nodes.back().path; }
};

}  // namespace raytube
