// What the direct hit shares of a launch tend to, exactly, and how far from that a finite number of rays may be.
#pragma once

#include <span>

#include "point_source/launch_model.h"

namespace raytube {

/// Of one part of a scene; shares are of 1.
struct LaunchLimit {
  double share = 0.0;  // of the model's measure that lies where the part is visible
  double bound = 0.0;  // how far first_hits / rays can be from it; random: four standard deviations
  double estimate_bound =
      0.0;  // how far the weighted estimate can be from the share of the solid angle; not for random, plane_wave
};

/// Of each part: `visible` is all that launch.eye() sees, `triangle_part` the part of each triangle, counted from 0.
///
/// The models with faces sample the area of these: the limit is the share of that area inside the cones through what is visible.
/// Azimuth and elevation in equal steps sample the plane of the two angles: there it is the area between the arcs that are the
/// edges of what is visible (see angle_area). Every cell of a grid that no such edge crosses counts right, a crossed one is wrong
/// by less than itself, which gives the bounds: the number of cells that the edges can cross, or the solid angle of these.
std::vector<LaunchLimit> launch_limits(const Launch& launch, std::span<const VisiblePiece> visible,
                                       std::span<const std::uint32_t> triangle_part, std::size_t parts, double tolerance);

/// The area that the directions to a polygon cover in the plane of azimuth and elevation, of 2 pi times pi. An edge is an arc of
/// a great circle, tan(elevation) = tan(highest) cos(azimuth - its own), so the area is the integral of the distance from the
/// pole over azimuth round the polygon.
double angle_area(const SpatialPolygon& polygon, const dvec3& from, double tolerance);

}  // namespace raytube
