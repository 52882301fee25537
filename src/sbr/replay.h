// Replay of single tubes, bounce by bounce.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/complex_vector.h"
#include "sbr/launch/launch.h"
#include "sbr/sbr.h"
#include "scene/tube_paths.h"

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
  double power;                        // of what was launched, the share that is reflected: mean of both polarisations
  bool goes_on = false;                // behind the surface, too
};

/// Where a tube parts from another at a sheet, to go on behind it.
struct TubeParting {
  std::size_t way = 0;                   // which it parts from, among those of the same tube
  int met = 0;                           // surfaces so far, the sheet as the last one; 0: it is the tube as launched
  std::array<ComplexVector, 2> field{};  // behind the sheet, of unit incident V and H
  double power = 1.0;                    // as TubeBounce::power
};

/// A tube from the launch grid to its end, or from a sheet that lets a part of it through.
struct TubeTrace {
  std::uint32_t column, row;                // the tube's cell in the launch grid
  dvec2 center;                             // launch coordinates of the cell's middle, counted from the mesh's own origin [m]
  dvec3 start;                              // of its ray, on the launch plane or the sheet, in recentred coordinates [m]
  dvec3 direction;                          // there
  std::vector<TubeBounce> bounces{};        // in order
  TubeEnd ended = TubeEnd::left_the_scene;  // why
  std::string end{};                        // the same in words
  double last_leg = 0.0;                    // from the last bounce to where the tube was truncated or lost [m]
  TubeParting parting{};                    // from which tube, and where
};

/// Replays tubes of one look, one by one. Keeps references to the scene.
class TubeReplay {
 public:
  /// The launch grid is that with which a run begins.
  TubeReplay(const ReplayScene& scene, const Look& look, double frequency_hz, const TubeOptions& options);

  /// The launch grid of the look.
  const LaunchGrid& grid() const { return grid_; }

  /// The tube of a cell of the grid by all its ways: what surfaces reflect of it, then what goes on behind the sheets met, those
  /// that part first before others, `most` of them at most. Thread-safe.
  std::vector<TubeTrace> follow(std::uint32_t column, std::uint32_t row, std::size_t most = most_ways) const;

  /// The tube whose cell holds the launch coordinates `at` [m], counted from the mesh's own origin; at a finite distance they are
  /// drawn at that of the middle of the mesh. Throws InputError outside the launch rectangle.
  std::vector<TubeTrace> follow(const dvec2& at, std::size_t most = most_ways) const;

  /// Between sheets they double at every meeting.
  static constexpr std::size_t most_ways = 256;

 private:
  dvec2 to_mesh_origin() const;

  ReplayScene scene_;
  Look look_;
  double wavenumber_;
  int max_bounces_;
  LaunchGrid grid_;
};

/// Replays the tube at launch coordinates, as TubeReplay does, by what surfaces reflect.
TubeTrace trace_tube(const ReplayScene& scene, const Look& look, double frequency_hz, const TubeOptions& options,
                     const dvec2& at);

}  // namespace raytube
