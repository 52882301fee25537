// What a solve will do, settled once before it begins: run, check, images, the random baseline and the memory estimate read it.
#pragma once

#include <memory>
#include <vector>

#include "mesh/smooth/smooth.h"
#include "scene/look_plan.h"
#include "scene/options.h"
#include "scene/skipped.h"
#include "scene/sweep.h"
#include "solve/target.h"

namespace raytube {

/// Whether waves run over curved surfaces, or why they do not.
enum class SurfaceWaveState {
  computed,           // they do
  not_asked,          // surfaces.waves is false
  no_edge_currents,   // edges.method is not fringe
  facets_meant,       // tubes.curved says that facets are the surface
  no_curved_surface,  // no facets stand for one
  no_conductor,       // none of them conducts perfectly
  near_antennas,      // looks are from a finite distance
  long_edges          // more than longest_surface_edges
};

/// What of a surface's edges they may run from [wavelength]: more strips start there than all the rest of a look would cost.
inline constexpr double longest_surface_edges = 200.0;

/// The reason in words, after which a remedy may follow; empty if they are computed.
const char* why_not(SurfaceWaveState state);

/// Which mechanisms take part.
struct Mechanisms {
  bool rays = false;            // edges.method utd: rays of geometrical optics and diffraction in the place of currents
  bool fringe = false;          // fringe currents of edges between perfect conductors
  bool material_edges = false;  // edges of other materials, by a heuristic
  bool screens = false;         // edges are lit, and radiate, through sheets that let waves through
  bool interaction = false;     // edge-face interaction
  bool surface_waves = false;   // over curved surfaces, beyond physical optics
};

/// Looks, frequencies and mechanisms of a solve, with the reasons for what is left out. Refers to `target` and `sweep`, which
/// must outlive it.
struct SolvePlan {
  /// Throws InputError, naming the remedy, for whatever cannot be solved: an empty or non-physical sweep, options out of range or
  /// that do not go together, antennas that do not have all of the target in front, grids too dense.
  SolvePlan(const Target& target, const Sweep& sweep, const SolveOptions& options);
  SolvePlan(const Target& target, Sweep&& sweep, const SolveOptions& options) = delete;
  SolvePlan(Target&& target, const Sweep& sweep, const SolveOptions& options) = delete;

  const Target& target;     // as given
  const Sweep& sweep;       // as given
  TubeOptions tubes;        // as asked, checked
  EdgeOptions edges;        // as asked, checked
  SurfaceOptions surfaces;  // as asked, checked
  int threads;              // 0: all cores
  bool keep_parts;          // the result keeps its mechanisms apart

  Convexity convexity;     // the target's; of a curved body with dents that no wave sees, that of the body without
  Mechanisms mechanisms;   // those that take part
  double ray_range = 0.0;  // of transmitter and receiver where rays stand for currents [m], else 0
  std::shared_ptr<const SmoothSurfaces> smooth;  // curved surfaces that tubes see as such; null: all are flat facets
  SurfaceWaveState surface_waves = SurfaceWaveState::not_asked;  // why, or why not
  std::shared_ptr<const SmoothSurfaces> wave_surfaces;           // over which waves run, or would; null: none
  LookPlan looks;                                                // which are computed, and which follow from these
  SkipCounts skips;                                              // known beforehand
  std::vector<Skipped>
      skipped_wedges;    // that carry no fringe current, and why; of thin plates and details at the lowest frequency
  double seconds = 0.0;  // that planning took

  double shortest_wavelength() const;  // [m]
  /// Bounces that tubes can have on this target.
  int max_bounces() const { return convexity.no_reflection ? 1 : tubes.max_bounces; }
};

/// Whether the waves of every look are plane enough all over the target for edge-face interaction, which knows no others.
bool waves_are_plane(const TriangleMesh& mesh, const Sweep& sweep);

}  // namespace raytube
