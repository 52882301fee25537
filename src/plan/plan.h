// What a solve will do, settled once before it begins: run, check, images and the memory estimate read it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mesh/features/wedge_sets.h"
#include "mesh/smooth/smooth.h"
#include "plan/ground_paths.h"
#include "plan/mechanism.h"
#include "plan/target.h"
#include "scene/look_plan.h"
#include "scene/options.h"
#include "scene/sweep.h"

namespace raytube {

class CornerWaves;

/// Frequencies of a sampled band (scene/frequency_bands.h) at which the target counts as the same body. Each is solved as if
/// there were no others.
struct BandPlan {
  std::vector<std::size_t> indices;  // in the list of the sweep
  std::vector<double> frequencies;   // [Hz]
  Convexity convexity;               // the target's; of a curved body with dents that no wave sees, that of the body without
  std::shared_ptr<const SmoothSurfaces> smooth{};         // curved surfaces that tubes see as such; null: all are flat facets
  std::shared_ptr<const SmoothSurfaces> wave_surfaces{};  // over which waves may run; null: none

  /// Of the highest frequency [m].
  double shortest_wavelength() const;
};

/// Looks and frequencies of a solve, and what all of its mechanisms share. Refers to the target and the sweep asked for, which
/// must outlive it.
struct SolvePlan {
  /// Throws InputError, naming the remedy, for whatever cannot be solved: an empty or non-physical sweep, options out of range or
  /// that do not go together, antennas that do not have all of the target in front, grids too dense. Over `ground` below the
  /// target the looks along its paths are solved, and added up; of a perfect one the target has its mirror image with it.
  /// What adds to S beside the tubes is in `list`.
  SolvePlan(const Target& target, const Sweep& sweep, const SolveOptions& options, const std::optional<Ground>& ground = {},
            const std::vector<MechanismEntry>& list = mechanism_list());
  SolvePlan(const Target& target, Sweep&& sweep, const SolveOptions& options, const std::optional<Ground>& ground = {},
            const std::vector<MechanismEntry>& list = mechanism_list()) = delete;
  SolvePlan(Target&& target, const Sweep& sweep, const SolveOptions& options, const std::optional<Ground>& ground = {},
            const std::vector<MechanismEntry>& list = mechanism_list()) = delete;

  const Target& target;                        // as given
  const Sweep& asked;                          // as given
  std::optional<Ground> ground;                // as given
  std::shared_ptr<const Sweep> along_paths{};  // over ground: `sweep`; else null
  const Sweep& sweep;                          // that is computed
  TubeOptions tubes;                           // as asked, checked
  EdgeOptions edges;                           // as asked, checked
  SurfaceOptions surfaces;                     // as asked, checked
  int threads;                                 // 0: all cores
  bool keep_parts;                             // mechanisms are kept apart; over ground always, to add them up
  bool tell_parts;                             // the result keeps them apart

  double ray_range = 0.0;       // of transmitter and receiver where rays stand for currents, without [radar] [m]; else 0
  std::vector<BandPlan> bands;  // every frequency is in one
  std::shared_ptr<const SmoothSurfaces> known_surfaces{};  // of the mesh, from which others are found with less work; may be null
  std::vector<ThinPlateEdge> thin_plate_edges;             // the target's that are known, thinnest first
  std::vector<WedgeSet> wedge_sets;                        // of all frequencies
  std::vector<std::shared_ptr<const CornerWaves>> corner_waves{};  // of each of these; none at edge order 1
  LookPlan looks;                                                  // which are computed, and which follow from these
  std::vector<Skipped> skips;                                      // looks and wedges that are known to need no work
  std::vector<Skipped> skipped_wedges;     // that carry no fringe current, and why; of thin plates and details at the lowest
                                           // frequency
  std::vector<MechanismEntry> mechanisms;  // beside the tubes, in the order in which they run
  std::vector<MechanismState> states;      // [mechanisms]
  double seconds = 0.0;                    // that planning took

  /// Rays of geometrical optics and diffraction stand for currents.
  bool rays() const { return edges.method == EdgeMethod::utd; }
  /// Edges between perfect conductors are asked for their fringe currents.
  bool fringe() const { return edges.method == EdgeMethod::fringe; }

  /// What adds up the paths, over ground.
  GroundReflections reflections() const { return {*ground, asked, sweep, target.mesh.center}; }

  /// Columns of S that a result has at most: one for each bounce, and those of the mechanisms.
  std::size_t columns() const;
  /// Where a mechanism of this name stands among `mechanisms`; throws std::out_of_range if it is not there.
  std::size_t index_of(std::string_view name) const;
  /// What it says of itself.
  const MechanismState& state(std::string_view name) const { return states[index_of(name)]; }

  double shortest_wavelength() const;  // [m]
  /// At every frequency nothing that a surface reflects meets another one.
  bool no_reflection() const;
  /// Bounces that tubes can have on this target.
  int max_bounces() const { return no_reflection() ? 1 : tubes.max_bounces; }
};

}  // namespace raytube
