// What strips from all along a line of the shadow boundary bring to wedges.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "utd/surface/shadow_boundary.h"
#include "utd/surface/surface_arrival.h"

namespace raytube {

/// A strip that has arrived at a wedge, one point of the integral over all that do.
struct ArrivingStrip {
  double at;  // arc length of its start along the line of the boundary [m]
  SurfaceArrival arrival;
  std::array<double, 2> magnetic;  // H of the wave where it starts along the binormal, transmit V and H
  std::vector<Complex> current;  // [frequency], half of it for unit H, times the strip's width over that of its piece of the line
  std::vector<Complex> weight;   // [frequency], of the integral along the line, with the phase [m]
};

/// The strip of a piece of the line, if it arrives at a wedge; its own current counts only if it `radiates`.
using StripOfPiece = std::function<std::optional<ArrivingStrip>(const BoundaryPiece&, bool radiates)>;

/// The strips of all pieces of a line, integrated along it: where strips graze the wedge their ends are far apart there, and
/// phases turn by more than one piece stands for. `wavelength` [m] is the shortest.
std::vector<SurfaceArrival> arrivals_along(const BoundaryLine& line, std::span<const double> wavenumbers, double wavelength,
                                           const StripOfPiece& strip_of);

}  // namespace raytube
