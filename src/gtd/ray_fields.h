// The method "utd": rays in the place of currents, as programs that trace single paths have them, to compare with these.
//
// In formulas: E_i is the incident field, E_s the field at the receiver less the one it would have without the target, k the
// wavenumber, `range` the distance of transmitter and receiver. A flat mirror or a straight edge has no finite far-zone S from a
// ray, so both stand at a finite range, and S is what they would read off if that were all they knew.
//   ray_surfaces.h       what surfaces do to rays, and which lines of sight they leave open
//   mirror_paths.h       reflected rays: image sources, and which of their paths are clear
//   diffracted_field.h   (utd/wedge) the field of a ray over one edge (Kouyoumjian & Pathak 1974)
//   ray_fields.h         their sum
#pragma once

#include "mesh/features/wedges.h"
#include "scene/sweep.h"
#include "gtd/mirror_paths.h"

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

/// Transmitter and receiver stand `range` [m] from the origin of the mesh's own coordinates, outside the target. With E_i(0) the
/// incident field at the origin, E_s = S E_i(0) e^{-jk range} / range, S in [m]. Antennas at a finite distance (scene/antenna.h)
/// stand where they are; each ray leaves and arrives with the fields that they have in its direction, over an edge in that of the
/// edge's nearest point. E_s is the sum of
///   the reflected paths of up to `most_bounces` mirrors (image sources), with the coefficients of plane waves of their
///   materials; the direct ray taken away where the target stands in it, behind sheets less what these let through; one ray over
///   every convex wedge of a conductor that has a line of sight to both at the point of the edge nearest to the diffraction
///   point.
/// A ray exactly on its shadow or reflection boundary has the weight 1/2 for every edge it touches, which then adds nothing. An
/// edge whose rays run exactly along one of its faces has the mean of what it has from both sides: half, nothing at a half plane.
/// All rays go straight on through sheets, which transmit them at their own angle (towards an edge, at that of its nearest
/// point).
class RayFields {
 public:
  /// Keeps references to all but the numbers. `materials` at the frequencies of every look, `range` of looks from afar, `radar`
  /// of others.
  RayFields(const Tracer& tracer, std::span<const Material> materials, std::span<const Wedge> wedges, double range,
            const Radar& radar, int most_bounces);
  RayFields(const RayFields&) = delete;

  RayLookResult look(const Look& look, std::span<const double> frequencies) const;

 private:
  class Sum;

  RaySurfaces surfaces_;
  std::span<const Wedge> wedges_;
  MirrorPaths mirrors_;
  double range_;
  const Radar& radar_;
  int most_bounces_;
};

/// Ten times the far-field distance 2 D^2 / wavelength, D the diameter of the sphere around the target, or ten times the target's
/// reach from the origin, whichever is more [m].
double default_ray_range(const TriangleMesh& mesh, double highest_frequency);

/// Throws InputError if the target reaches as far as `range` from the origin of the mesh's own coordinates.
void check_ray_range(const TriangleMesh& mesh, double range);

}  // namespace raytube
