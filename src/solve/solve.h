// The public API: a target, a sweep and options in; complex polarimetric amplitudes out.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "mesh/features/convexity.h"
#include "mesh/features/outlines.h"
#include "mesh/features/thin_plates.h"
#include "mesh/load.h"
#include "mesh/model/face_tree.h"
#include "mesh/trace/tracer.h"
#include "sbr/sbr.h"
#include "scene/look_plan.h"
#include "scene/options.h"
#include "scene/results.h"
#include "scene/sweep.h"

namespace raytube {

/// A mesh ready to be solved: its ray-tracing structures, wedges, outlines of their faces, and the narrow faces that may be edges
/// of thin plates (none without `thin_plates`). Owns the mesh; can be moved, not copied.
struct Target {
  explicit Target(TriangleMesh mesh, const WedgeOptions& options = {});

 private:
  std::unique_ptr<const TriangleMesh> owned_;  // where it stays when the target is moved

 public:
  const TriangleMesh& mesh;
  WedgeOptions options;
  Tracer tracer;
  FaceTree faces;
  Convexity convexity;
  std::vector<Wedge> wedges;
  std::uint64_t wedges_enclosed;  // of these, marked so
  Outlines outlines;
  std::vector<ThinPlateEdge> rims;
};

/// Which looks are computed, and which follow from these. Images of looks follow where tubes are cut exactly: the grid of uniform
/// tubes, and of those that curved surfaces reflect, is not its own image; nor are radars at a finite distance from the origin.
LookPlan plan_of(const Target& target, const Sweep& sweep, const TubeOptions& tubes, EdgeMethod method);

/// At which frequencies of a sweep the target has too many edges and surfaces for waves between them; empty where these are not
/// asked for, or where nothing stands in front of any face.
std::vector<bool> above_interaction_limit(const Target& target, const Sweep& sweep, const EdgeOptions& edges);

/// Looks from a finite distance that would have waves between surfaces from afar.
std::uint64_t looks_too_near_for_interaction(const Target& target, const Sweep& sweep, const EdgeOptions& edges);

/// Looks that would have waves between surfaces if all of these were perfect conductors.
std::uint64_t looks_without_interaction_for_materials(const Target& target, const Sweep& sweep, const EdgeOptions& edges);

/// The wedges whose fringe currents a solve leaves out, and why; of the rims, what is left out at the lowest frequency.
std::vector<Skipped> skipped_wedges(std::span<const Wedge> wedges, std::span<const ThinPlateEdge> rims, const EdgeOptions& edges,
                                    std::span<const double> frequencies);

/// Throws InputError if an antenna at a finite distance has not all of the target in front, or its pattern ends on it.
void check_antennas(const TriangleMesh& mesh, const Sweep& sweep);

/// The most tubes per wavelength that every look of a sweep takes (densest_grid).
double densest_tubes(const TriangleMesh& mesh, const Sweep& sweep, const TubeOptions& tubes);

/// Throws InputError, with the density that would fit, if a look would have to begin with more.
void check_density(const TriangleMesh& mesh, const Sweep& sweep, const TubeOptions& tubes, EdgeMethod method);

/// Where transmitter and receiver stand with method utd [m], 0 with another one.
double ray_range(const Target& target, const Sweep& sweep, const EdgeOptions& edges);

/// S of every row of the sweep, phase reference at the origin of the mesh's own coordinates. The same bytes for any
/// number of threads. Throws InputError for an empty or non-physical sweep, Interrupted when `progress` says stop.
SweepResult solve(const Target& target, const Sweep& sweep, const SolveOptions& options = {});

}  // namespace raytube
