// What a solve will do, settled once before it begins: run, check, images, the random baseline and the memory estimate read it.
// Which mechanisms take part, and why others do not, they say themselves (solve/mechanisms/list.h).
#pragma once

#include <memory>
#include <vector>

#include "mesh/features/wedge_sets.h"
#include "mesh/smooth/smooth.h"
#include "plan/target.h"
#include "scene/look_plan.h"
#include "scene/options.h"
#include "scene/skipped.h"
#include "scene/sweep.h"

namespace raytube {

/// Frequencies at which the target counts as the same body. Each is solved as if there were no others.
struct BandPlan {
  std::vector<std::size_t> indices;  // in the list of the sweep
  std::vector<double> frequencies;   // [Hz]
  Convexity convexity;               // the target's; of a curved body with dents that no wave sees, that of the body without
  std::shared_ptr<const SmoothSurfaces> smooth{};         // curved surfaces that tubes see as such; null: all are flat facets
  std::shared_ptr<const SmoothSurfaces> wave_surfaces{};  // over which waves may run; null: none

  /// Of the highest frequency [m].
  double shortest_wavelength() const;
};

/// Looks and frequencies of a solve, and what all of its mechanisms share. Refers to `target` and `sweep`, which must outlive it.
struct SolvePlan {
  /// Throws InputError, naming the remedy, for whatever cannot be solved: an empty or non-physical sweep, options out of range or
  /// that do not go together, antennas that do not have all of the target in front, grids too dense.
  SolvePlan(const Target& target, const Sweep& sweep, const SolveOptions& options);
  SolvePlan(const Target& target, Sweep&& sweep, const SolveOptions& options) = delete;
  SolvePlan(Target&& target, const Sweep& sweep, const SolveOptions& options) = delete;
  /// Of a sweep that the plan keeps itself.
  SolvePlan(const Target& target, std::shared_ptr<const Sweep> sweep, const SolveOptions& options);

  const Target& target;     // as given
  const Sweep& sweep;       // as given
  TubeOptions tubes;        // as asked, checked
  EdgeOptions edges;        // as asked, checked
  SurfaceOptions surfaces;  // as asked, checked
  int threads;              // 0: all cores
  bool keep_parts;          // the result keeps its mechanisms apart

  double ray_range = 0.0;       // of transmitter and receiver where rays stand for currents, without [radar] [m]; else 0
  std::vector<BandPlan> bands;  // every frequency is in one
  std::shared_ptr<const SmoothSurfaces> known_surfaces{};  // of the mesh, from which others are found with less work; may be null
  std::vector<WedgeSet> wedge_sets;                        // of all frequencies
  LookPlan looks;                                          // which are computed, and which follow from these
  SkipCounts skips;                                        // known beforehand
  std::vector<Skipped> skipped_wedges;        // that carry no fringe current, and why; of thin plates and details at the lowest
                                              // frequency
  double seconds = 0.0;                       // that planning took
  std::shared_ptr<const Sweep> kept_sweep{};  // `sweep`, where the plan keeps it; else null

  /// Rays of geometrical optics and diffraction stand for currents.
  bool rays() const { return edges.method == EdgeMethod::utd; }
  /// Edges between perfect conductors are asked for their fringe currents.
  bool fringe() const { return edges.method == EdgeMethod::fringe; }

  double shortest_wavelength() const;  // [m]
  /// At every frequency nothing that a surface reflects meets another one.
  bool no_reflection() const;
  /// Bounces that tubes can have on this target.
  int max_bounces() const { return no_reflection() ? 1 : tubes.max_bounces; }
};

}  // namespace raytube
