// Shooting and bouncing rays: the physical-optics currents of every bounce of every tube of one look.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/field.h"
#include "core/progress.h"
#include "mesh/features/convexity.h"
#include "mesh/features/smooth.h"
#include "mesh/model/face_tree.h"
#include "mesh/trace/tracer.h"
#include "sbr/beams/tube_sums.h"
#include "scene/options.h"
#include "scene/sweep.h"

namespace raytube {

/// Cells per wavelength of the first grid of a look; clipped adaptive tubes become finer where they have to.
double first_density(const TubeOptions& options);

class CurrentMap;

/// Traces the tubes of a look once and integrates the PO current of every bounce, radiating unblocked, for all frequencies [Hz]
/// and both transmit polarisations. Phase reference: the centre of the mesh, of looks from a finite distance the origin of its
/// own coordinates. The result does not depend on the number of threads. Reports its finished tiles as shares of `share` to
/// `progress`. `faces`, `tracer`, `smooth` and `convexity` are of the same mesh; without `smooth`
/// every facet is flat; with it, and antennas at a finite distance, nothing of the target may reflect onto the rest. A `map` is
/// told where the currents are, in the last trace.
TubeSums sbr_scattering(const Tracer& tracer, const FaceTree& faces, const SmoothSurfaces* smooth, const Convexity& convexity,
                        const Look& look, std::span<const double> frequencies, const TubeOptions& options, Progress& progress,
                        double share, const Radar& radar = {}, std::span<const Material> materials = {},
                        CurrentMap* map = nullptr);

/// Bytes that the sums of one look under way take at most, with so many tiles, bounces and frequencies.
double look_sum_bytes(std::size_t tiles, int bounces, std::size_t frequencies);

/// Bytes that the tubes of one tile take where as many as may be are between sheets, few of which stand behind one another.
double tubes_between_sheets_bytes(std::size_t frequencies);

/// Tiles of a look: blocks of the launch grid of a look, groups of faces where tubes are adaptive.
std::size_t tiles_of_look(const Tracer& tracer, const FaceTree& faces, const Look& look, std::span<const double> frequencies,
                          const TubeOptions& options);

/// One reflection of a replayed tube, in recentred coordinates.
struct TubeBounce {
  std::uint32_t triangle, patch;
  dvec3 point, normal;  // normal on the side the tube comes from
  dvec3 direction_out;
  double path;                         // [m] phase path, less that of the wave at the origin of the mesh's coordinates
  std::array<ComplexVector, 2> field;  // reflected field of unit incident V and H
  bool goes_on = false;                // behind the surface, too: of that nothing is replayed
};

struct TubeTrace {
  std::uint32_t column, row;  // the tube's cell in the launch grid
  dvec2 center;               // (u, v) of the cell's middle on the launch axes, origin = mesh origin [m]
  dvec3 direction;            // as launched
  std::vector<TubeBounce> bounces;
  std::string end;  // why the tube ended
};

/// Replays the tube whose cell holds (u, v), launch coordinates in metres with the mesh's own origin. Throws InputError
/// outside the launch rectangle. At a finite distance the axes are drawn at that of the middle of the mesh. `materials` are those
/// of one frequency.
TubeTrace trace_tube(const Tracer& tracer, const Look& look, double frequency_hz, const TubeOptions& options, double u, double v,
                     const Radar& radar = {}, std::span<const Material> materials = {});

}  // namespace raytube
