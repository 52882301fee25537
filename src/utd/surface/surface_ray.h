// Geodesics over the facets of curved surfaces.
#pragma once

#include "mesh/smooth/curvature_field.h"

namespace raytube {

/// A point of a surface on one of its facets: barycentric coordinates 1 - l.x - l.y, l.x, l.y.
struct FacetPoint {
  std::uint32_t triangle;
  dvec2 l;
};

/// A straight piece of a geodesic over one facet.
struct GeodesicPiece {
  FacetPoint from;
  dvec2 to;         // barycentric coordinates
  dvec3 end;        // the point of the surface there
  dvec3 direction;  // in the facet's plane, of any length
};

/// Length of an arc of that curvature over a chord [m], of points of one facet: at slivers, whose curvature may be anything, it
/// is half a circle at most.
double arc_over(double chord, double curvature);

/// A geodesic of a curved surface over its facets: in the plane of its tangent and of the normal on each of them, and with the
/// tangent carried along by the normals, which are the same on both sides of an edge and all round a vertex. So no path hangs on
/// which facet a point on an edge is counted to. Ends where the surface does. Keeps a reference to the field.
class Geodesic {
 public:
  Geodesic(const CurvatureField& curvatures, const FacetPoint& start, const dvec3& direction);

  /// The next piece, false if there is none.
  bool next(GeodesicPiece& piece);

  /// The side of its facet at which the last piece ended the geodesic, by the corner it begins at; -1: it did not end at one.
  int ended_at() const { return ended_ ? entered_ : -1; }

 private:
  struct Exit {
    int side = -1;
    double length = 0.0;  // of the direction
  };
  Exit exit(const dvec2& rate) const;

  const CurvatureField& curvatures_;
  FacetPoint at_;
  dvec3 tangent_;     // before it is carried to this facet, of any length
  int entered_ = -1;  // the side over which it came
  int standing_ = 0;  // pieces without length in a row
  bool ended_ = false;
};

}  // namespace raytube
