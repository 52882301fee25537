// The ways that the tubes of a look take, and the facets that they meet: plain data, for pictures.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/field.h"

namespace raytube {

/// Why a tube goes no further.
enum class TubeEnd {
  left_the_scene,  // nothing more is in its way
  truncated,       // it would go on after the most bounces allowed
  lost,            // it met a closed body from inside
  absorbed,        // the last surface reflects nothing
  transmitted,     // the same, but lets something through
};

/// A point of the launch plane, of a sheet that the tube has passed, of a surface that reflects it, or where it ends.
struct TubePathPoint {
  dvec3 position;              // in the mesh's own coordinates [m]
  int bounce = 0;              // surfaces met so far, with that of the point
  double path_length = 0.0;    // from the launch plane [m]
  double power = 1.0;          // of what was launched, the share that leaves the point: mean of both polarisations
  std::int64_t triangle = -1;  // of the mesh as traced, that reflects here; -1: none does
};

/// From the launch plane over every bounce to where the tube ends; if it left the scene, on a sphere about the target. What goes
/// on behind a sheet is a path of its own, which begins there.
struct TubePath {
  std::uint32_t column = 0, row = 0;      // its cell of the launch grid
  double area = 0.0;                      // of the cells for which it stands [m^2]
  TubeEnd end = TubeEnd::left_the_scene;  // why it ends
  std::vector<TubePathPoint> points{};    // in order, two or more
  bool lit_by_ground = false;             // the wave that it is of was reflected by the ground

  /// As launched, from the launch plane.
  bool launched() const { return points.front().bounce == 0; }
  /// Surfaces met in all.
  int bounces() const { return points.back().bounce; }
  /// From the launch plane to the end [m].
  double length() const { return points.back().path_length; }
  /// For an incident wave of 1 W/m^2, what it carries in the end [W].
  double power() const { return area * points.back().power; }
};

/// The tubes of one look.
struct TubePaths {
  std::uint32_t columns = 0, rows = 0;  // of the launch grid
  std::uint32_t stride = 1;             // one tube of every block of so many columns and rows was followed
  std::uint64_t followed = 0;           // with those that met nothing
  std::vector<TubePath> paths{};        // of those that met the target, row by row, each before its ways on behind sheets

  /// How many of the paths are tubes as launched.
  std::size_t met_target() const { return static_cast<std::size_t>(std::ranges::count_if(paths, &TubePath::launched)); }
};

/// Puts the tubes of the wave that the ground reflects beside those of the straight one.
void add_lit_by_ground(TubePaths& straight, TubePaths by_ground);

/// How many of the tubes followed met each facet.
struct FacetHits {
  std::vector<std::vector<std::uint32_t>> at_bounce;  // [bounce, from the first one][triangle]

  /// Tubes that met each triangle at any bounce.
  std::vector<std::uint32_t> at_any_bounce() const;
};

/// The tubes that met each of so many triangles, for as many bounces as any of the tubes has.
FacetHits facet_hits(const TubePaths& tubes, std::size_t triangles);

}  // namespace raytube
