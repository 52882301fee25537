// Convex polygons in space, cut by planes, and the share of a sphere they cover.
#pragma once

#include <span>
#include <vector>

#include "core/field.h"

namespace raytube {

/// Corners in order round a plane convex polygon, in either sense; fewer than three: nothing.
using SpatialPolygon = std::vector<dvec3>;

/// normal . r - offset is the distance to the plane, positive inside; normal is a unit vector.
struct HalfSpace {
  dvec3 normal{0.0};
  double offset = 0.0;
  double operator()(const dvec3& r) const { return glm::dot(normal, r) - offset; }
};

double area(const SpatialPolygon& polygon);   // [m^2]
dvec3 middle(const SpatialPolygon& polygon);  // mean of the corners, which lies inside

/// Cuts along the plane. A corner within the tolerance belongs to both parts; a part without a corner beyond that is left empty.
void cut(const SpatialPolygon& polygon, const HalfSpace& plane, double tolerance, SpatialPolygon& inside,
         SpatialPolygon& outside);

/// Solid angle of the triangle whose corners lie at a, b, c from the observer, never negative: van Oosterom & Strackee, IEEE
/// Trans. Biomed. Eng. BME-30 (1983) 125, eq. 8. Valid when the observer is not on the triangle itself.
double solid_angle(const dvec3& a, const dvec3& b, const dvec3& c);

/// Solid angle of a convex polygon as seen from `from`: the sum over a fan of triangles.
double solid_angle(const SpatialPolygon& polygon, const dvec3& from);

}  // namespace raytube
