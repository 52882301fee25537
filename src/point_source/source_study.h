// The room of point sources: ways to launch rays from a point, and the command `raytube sources` that studies them. Nothing else
// of the program knows of them but that the command is in its list.
//
//     source_case        the case file;  source_tracing: its scene, traced from every position by every model
//     launch_model       spreads the rays;  ray_hits: follows them and counts what they meet
//     source_visibility  with visibility_border, spatial_polygon: what the source sees, exactly
//     launch_limit       what the counts tend to
//     sources_csv        the table, and clouds of points;  command: options, files, and what is printed
//
// This file: what was found, as plain data.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/field.h"

namespace raytube {

/// How rays are spread over the directions from a source.
enum class LaunchModel {
  random,      // through random points of the enclosing box
  angles,      // equal steps of azimuth and elevation
  octahedron,  // through the facets of an octahedron split repeatedly
  box_grid,    // through a uniform grid on the six walls of the enclosing box
  plane_wave,  // parallel, from a uniform grid on one wall of it
  geometry     // towards a constant number of points on every triangle of the scene
};

inline constexpr std::array<std::string_view, 6> launch_model_names = {"random",   "angles",     "octahedron",
                                                                       "box-grid", "plane-wave", "geometry"};

constexpr std::string_view launch_model_name(LaunchModel model) { return launch_model_names[static_cast<std::size_t>(model)]; }

/// The surface of a part of the scene: a mirror, or the end of every ray.
enum class RaySurface { pec, absorber };

inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// What the rays of one launch found of one part of the scene. Shares are of 1.
struct PartHits {
  std::uint64_t first_hits = 0;  // rays that meet it before anything else
  std::uint64_t all_hits = 0;    // a ray as often as it comes back
  double limit = not_known;      // what first_hits / rays tends to, exact: a property of the model
  double limit_bound = not_known;
  double estimate = not_known;  // of the share of the solid angle, each ray weighted by what it stands for
  double estimate_bound = not_known;
  double response = not_known;  // hits per ray of an isotropic source: all_hits weighted as the estimate is
  double exact = not_known;     // the share of the full solid angle in which the source sees the part
};

/// One launch: every ray escapes, ends at an absorber or is cut after the last reflection allowed.
struct SourceRun {
  std::size_t position = 0;  // of the source, counted from 0
  dvec3 point{0.0};
  LaunchModel model = LaunchModel::random;
  std::uint64_t rays_asked = 0, rays = 0;
  std::uint64_t escaped = 0, absorbed = 0, cut = 0, missed = 0;  // missed: met nothing at all
  double seconds = 0.0;                                          // launch, trace and count
  std::vector<PartHits> parts;
};

/// A point where a ray met the counted part; bounce 0 is a direct hit.
struct CountedHit {
  dvec3 point;
  std::uint32_t bounce;
};

/// What the pictures show of one launch model, in the coordinates of the case.
struct SourceView {
  LaunchModel model = LaunchModel::random;
  std::uint64_t launched = 0, traced = 0;  // rays of which the launch points and the hits are shown
  std::vector<dvec3> launch_points;
  std::vector<CountedHit> hits;
};

/// All that `raytube sources` reports. Runs: position slowest, then model, then the number of rays.
struct SourceStudy {
  std::string title;
  std::vector<std::string> part_names;
  std::size_t counted = 0;  // the part whose hits are shown
  std::vector<SourceRun> runs;
  std::vector<SourceView> views;  // of the first position
};

}  // namespace raytube
