// Replay of a single tube, bounce by bounce.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/complex_vector.h"
#include "sbr/sbr.h"

namespace raytube {

/// What a replayed tube meets: materials are those of its one frequency, the radar that of looks from a finite distance.
struct ReplayScene {
  const Tracer& tracer;                   // of the target
  std::span<const Material> materials{};  // [Patch::material]
  const Radar& radar = isotropic_radar;   // of looks from a finite distance
};

/// One reflection of a replayed tube, in recentred coordinates [m].
struct TubeBounce {
  std::uint32_t triangle, patch;       // that it meets
  dvec3 point, normal;                 // normal on the side the tube comes from
  dvec3 direction_out;                 // of the reflected tube, unit
  double path;                         // phase path, less that of the wave at the origin of the mesh's coordinates [m]
  std::array<ComplexVector, 2> field;  // reflected field of unit incident V and H
  bool goes_on = false;                // behind the surface, too: of that nothing is replayed
};

/// A tube from the launch grid to its end.
struct TubeTrace {
  std::uint32_t column, row;        // the tube's cell in the launch grid
  dvec2 center;                     // launch coordinates of the cell's middle, counted from the mesh's own origin [m]
  dvec3 direction;                  // as launched
  std::vector<TubeBounce> bounces;  // in order
  std::string end;                  // why the tube ended
};

/// Replays the tube whose cell holds the launch coordinates `at` [m], counted from the mesh's own origin; at a finite distance
/// they are drawn at that of the middle of the mesh. Throws InputError outside the launch rectangle, and for materials at a
/// finite distance.
TubeTrace trace_tube(const ReplayScene& scene, const Look& look, double frequency_hz, const TubeOptions& options,
                     const dvec2& at);

}  // namespace raytube
