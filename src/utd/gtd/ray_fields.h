// A target as a tracer of single paths sees it: rays of geometrical optics times their spreading, and rays that one edge
// diffracts. For comparison with such programs. A flat mirror or a straight edge has no finite far-zone S from a ray, so
// transmitter and receiver stand at a finite distance and S is what they would read off if their range were all they knew.
#pragma once

#include "mesh/features/wedges.h"
#include "scene/sweep.h"
#include "utd/gtd/mirror_paths.h"

namespace raytube {

struct RayLookResult {
  // Phase reference: centre of the mesh.
  std::vector<std::vector<ScatteringMatrix>> bounces;  // [reflections - 1][frequency]; the first holds the shadow too
  std::vector<ScatteringMatrix> edges;                 // [frequency]
  std::vector<std::uint64_t> paths;                    // [reflections - 1]
  std::uint64_t edge_rays = 0;
  std::uint64_t rays = 0;  // traced to find them
  bool cut = false;        // see MirrorPathList
};

/// Transmitter and receiver stand `range` [m] from the origin of the mesh's own coordinates, outside the target. With E_s the
/// field at the receiver less that which it would have without the target, and E_i(0) the one at the origin without it, E_s = S
/// E_i(0) e^{-jk range} / range. E_s is the sum of
///   the reflected paths of up to `most_bounces` mirrors (image sources);
///   the direct ray taken away where the target stands in it;
///   one ray over every convex wedge that both see at the point of the edge nearest to the diffraction point
///   (diffracted_field.h).
/// A ray exactly on the boundary of its light has the weight 1/2 for every edge it touches, which then adds nothing. Seen exactly
/// along one of its faces an edge has the mean of what it has from both sides: half, nothing at a half plane.
class RayFields {
 public:
  /// Keeps references to all but the numbers.
  RayFields(const Tracer& tracer, std::span<const Wedge> wedges, double range, int most_bounces);

  RayLookResult look(const Look& look, std::span<const double> frequencies) const;

 private:
  class Sum;

  const Tracer& tracer_;
  std::span<const Wedge> wedges_;
  MirrorPaths mirrors_;
  double range_;
  int most_bounces_;
};

/// Ten times the far-field distance 2 D^2 / wavelength, D the diameter of the sphere around the target, or ten times the target's
/// reach from the origin, whichever is more [m].
double default_ray_range(const TriangleMesh& mesh, double highest_frequency);

/// Throws InputError if the target reaches as far as `range` from the origin of the mesh's own coordinates.
void check_ray_range(const TriangleMesh& mesh, double range);

}  // namespace raytube
