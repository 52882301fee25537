// Directions all round a target on a flat picture of equal areas.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/field.h"
#include "output/tables/sweep_map.h"

namespace raytube {

/// The projection of Hammer (1892), equal in area, of the unit sphere: Snyder and Voxland, An Album of Map Projections, USGS
/// Professional Paper 1453 (1989). theta from the top, phi = 0 in the middle and rising to the right [degrees]; the
/// whole sphere fills an ellipse of 4 sqrt(2) by 2 sqrt(2).
dvec2 hammer(double theta_deg, double phi_deg);

/// theta and phi, -180 ... 180, of a point [degrees]; none outside the ellipse.
std::optional<dvec2> from_hammer(const dvec2& point);

/// Whether a map over azimuth goes all round and over a third of the polar angles at least.
bool covers_sphere(const SweepMap& map);

/// A map on even dots of that projection.
struct SphereMap {
  dvec2 low, high;           // bounds of the part of the ellipse that is shown
  std::size_t across, up;    // dots
  std::vector<double> dots;  // lines from below; NaN: nothing there

  double aspect() const { return (high.x - low.x) / (high.y - low.y); }
};

/// Its bounds and the number of its dots, without the dots.
SphereMap sphere_frame(const SweepMap& map);

/// `levels` has one for each place of the map. A dot takes the strongest of the rows in it, otherwise the nearest one.
SphereMap sphere_map(const SweepMap& map, const std::vector<double>& levels);

/// Meridians and parallels every 30 degrees where the map reaches, and its border, as lines of gnuplot's data; and the commands
/// that label them.
std::string graticule(const SweepMap& map);
std::string outline(const SweepMap& map);
std::string graticule_labels(const SweepMap& map);

}  // namespace raytube
