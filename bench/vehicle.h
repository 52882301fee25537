// A wheel loader of boxes, cylinders, tyres and a bucket, as fine as one likes.
#pragma once

#include "mesh/load.h"

namespace raytube::bench {

/// About `triangles` triangles of equal size [m]: 7 m long, 3 m high, driving along +x, z up. Closed bodies, some of which run
/// into one another, and an open bucket. Flat parts are one patch each; tyres, wheels, rods, pipe and bucket are curved.
PolygonSoup vehicle(double triangles);

}  // namespace raytube::bench
