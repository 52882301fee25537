// Where a wave leaves curved surfaces in the dark.
#pragma once

#include <array>
#include <vector>

#include "utd/surface/curved_target.h"
#include "utd/surface/local_look.h"
#include "utd/surface/surface_ray.h"

namespace raytube {

/// A piece of a shadow boundary.
struct BoundaryPiece {
  FacetPoint middle;  // half way along it
  dvec3 chord;        // from its one end to the other [m]
  double from, to;    // places of these ends along their line
  double arc_length;  // place of the middle along the line [m]
};

/// A line on which the normals, linear over the facets, are across the wave.
class BoundaryLine {
 public:
  /// A crossing of a facet, in the order in which the line passes them.
  struct Crossing {
    std::uint32_t triangle;
    std::array<dvec2, 2> ends;    // barycentric coordinates of where it enters and leaves
    std::array<dvec3, 2> points;  // where these ends are [m]
    double measure;               // in pieces of the boundary
  };

  /// `ends`: the places where the stretches that are divided equally meet, of a closed line by up to its whole measure further.
  BoundaryLine(std::vector<Crossing> crossings, bool closed, std::vector<double> ends);

  /// Where it ends, it meets the end of the surface.
  bool closed() const { return closed_; }
  double measure() const { return sums_.back(); }
  double length() const { return lengths_.back(); }  // [m]

  /// Each stretch in equal pieces of a measure of 1 at most.
  std::vector<BoundaryPiece> pieces() const;

  /// The piece between two places; of a closed line those beyond its measure go on from its beginning.
  BoundaryPiece piece(double from, double to) const;
  /// The length from where the line begins to a place on it [m].
  double arc_length(double at) const { return place(at).arc_length; }

 private:
  struct Place {
    FacetPoint on;
    dvec3 position;
    double arc_length;
  };
  Place place(double at) const;

  std::vector<Crossing> crossings_;
  bool closed_;
  std::vector<double> ends_, sums_{0.0}, lengths_{0.0};
};

/// All lines of a look. A piece of them has a measure of 1 that is `widest` [m] long, or over which the normal turns by
/// `most_turn` [rad], whichever is shorter. Closed lines are divided stretch by stretch, from one place farthest from their
/// centroid to the next. So pieces hang on where lines run alone, and mirror images of bodies have mirror images of pieces.
std::vector<BoundaryLine> shadow_boundary(const CurvedTarget& target, const LocalLook& look, double widest, double most_turn);

}  // namespace raytube
