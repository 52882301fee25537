// Shooting and bouncing rays: the physical-optics currents of every bounce of every tube of one look.
//
//   S_pq = sum over bounces and tubes of  -(jk / 4 pi) p . integral of eta J_q e^{jk s.r} dA,   J_q = 2 n x H_q
//
// k: wavenumber; s: direction to the receiver; p, q: receive and transmit polarisation; n, r: normal and points of the surface
// that a tube meets; H_q: magnetic field of the wave that the tube carries there, by geometrical optics. Every current radiates
// unblocked: what stands in the way carries currents of its own, which cancel it. Time convention e^{+j omega t}.
//
// The folders, each includes only from those before it:
//   launch    the launch plane: grid, cells, polygons
//   beams     waves between surfaces, their currents and far fields, sums, tolerances; TubeLook, what all tubes of a look share
//   visible   beam visibility, and line-of-sight transmission to the receiver
//   flat      tubes on flat faces: polygons (polygon_tubes) and single cells (tile_tracer)
//   curved    tubes on curved surfaces, and what these reflect
//   solid     tubes that refract into bodies, go on inside and leave
// Here: look_parts traces one of the parts of a look, sbr refines them together; replay follows one tube.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/field.h"
#include "core/progress.h"
#include "mesh/features/convexity.h"
#include "mesh/model/face_tree.h"
#include "mesh/smooth/smooth.h"
#include "mesh/trace/tracer.h"
#include "sbr/beams/tube_sums.h"
#include "scene/options.h"
#include "scene/sweep.h"

namespace raytube {

/// Where the currents of a trace lie on the target (sbr/beams/current_map.h).
class CurrentMap;

/// Antennas without a pattern: what they are aimed at does not matter.
inline const Radar isotropic_radar{};

/// What tubes meet, all of one mesh, and the antennas of looks from a finite distance. With `smooth` and such antennas nothing of
/// the target may reflect onto the rest.
struct TubeScene {
  const Tracer& tracer;                    // rays against the mesh
  const FaceTree& faces;                   // its faces
  const SmoothSurfaces* smooth = nullptr;  // curved surfaces; null: every facet is flat
  Convexity convexity{};                   // of the mesh
  std::span<const Material> materials{};   // [Patch::material]
  const Radar& radar = isotropic_radar;    // of looks from a finite distance
};

/// Where a trace reports to, and whom it asks.
struct TubeWork {
  Progress& progress;         // told as tiles are done
  double share = 1.0;         // of the progress that this look is
  CurrentMap* map = nullptr;  // takes every current of the last trace as well; null: none is asked for
  /// Errors [m] of a look with these sums, [frequency], that are no reason to refine it whatever the tolerance; asked only where
  /// it is exceeded. Empty: there are none.
  std::function<std::vector<ChannelErrors>(const TubeSums&)> permits{};
};

/// Traces the tubes of a look and integrates the PO current of every bounce, radiating unblocked, for all frequencies [Hz] and
/// both transmit polarisations: S [m], its estimated error and the counts. Where the options refine, again with smaller cells
/// until the error is within the tolerance, or within what is permitted. Phase reference: the centre of the mesh, of looks from a
/// finite distance the origin of its own coordinates. The result does not depend on the number of threads. Throws InputError
/// where the grid would be too dense.
TubeSums sbr_scattering(const TubeScene& scene, const Look& look, std::span<const double> frequencies, const TubeOptions& options,
                        const TubeWork& work);

/// Cells per wavelength of the first grid of a look; adaptive tubes become finer where they have to, and polygons begin
/// with what suits the tolerance.
double first_density(const TubeOptions& options);

/// Bytes that the sums of one look under way take at most, with so many tiles, bounces and frequencies.
double look_sum_bytes(std::size_t tiles, int bounces, std::size_t frequencies);

/// Bytes that the sums of a look's blocks take at most, which are kept while some of them are refined.
double block_sum_bytes(std::size_t tiles, int bounces, std::size_t frequencies);

/// Bytes that the tubes of one tile take at most where they are between sheets, few of which stand behind one another.
double tubes_between_sheets_bytes(std::size_t frequencies);

/// Tiles that a part of a look has at most: blocks of the launch grid, groups of faces where tubes are adaptive, smaller ones
/// between sheets, or of triangles that waves enter solids by.
std::size_t tiles_of_look(const Tracer& tracer, const FaceTree& faces, const Look& look, std::span<const double> frequencies,
                          const TubeOptions& options, std::span<const Material> materials);

}  // namespace raytube
