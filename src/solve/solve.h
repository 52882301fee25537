// The public API: a target, a sweep and options in; complex polarimetric amplitudes out.
#pragma once

#include <functional>
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
#include "scene/sweep.h"
#include "utd/wedge/transition.h"

namespace raytube {

/// What edges add. utd: no currents at all, but rays of geometrical optics and rays that one edge diffracts
/// (utd/gtd/ray_fields.h), a mode to compare with programs that trace paths.
enum class EdgeMethod { none, fringe, utd };

/// What edges add beside other materials than perfect conductors. luebbers: utd/fringe/material_edges.h.
enum class MaterialEdgeMethod { none, luebbers };

struct EdgeOptions {
  EdgeMethod method = EdgeMethod::fringe;
  int order = 3;                 // edges in a row that a current passes, 1 to 3; 1 takes every face as endless
  bool interaction = true;       // edges light other surfaces: diffraction between surfaces
  bool receiver_shadow = false;  // an edge hidden from the receiver does not count
  TransitionTier transition = TransitionTier::exact;  // of the transition function; plays a part at order 2 and 3 only
  MaterialEdgeMethod materials = MaterialEdgeMethod::none;
  bool thin_plates = true;                 // the rim of a sheet thinner than wavelength / 10 is the edge of a half plane
  double utd_range = 0.0;                  // of transmitter and receiver with method utd [m]; 0: default_ray_range
  double min_wedge_angle = 15.0 * degree;  // a crease flatter than this is tessellation, not an edge [rad]
};

/// Finished looks in the hands of whoever calls, as bytes whose meaning is the solver's own (of the same program, target, sweep
/// and options): a solve that was stopped goes on from them and gives the same bits as one that was not.
struct KeptLooks {
  std::function<void(std::size_t looks)> begin;                    // told first: how many are computed in all
  std::function<std::string(std::size_t place)> find;              // those kept for one of them; empty: it has to be computed
  std::function<void(std::size_t place, std::string bytes)> keep;  // of one just computed. Both from any thread
};

struct SolveOptions {
  TubeOptions tubes;
  EdgeOptions edges;
  int threads = 0;          // 0: all cores
  bool keep_parts = false;  // fill SweepResult::bounces and edges
  /// Called now and then with the finished share of the work (0..1); return false to stop (solve then throws Interrupted).
  std::function<bool(double)> progress;
  KeptLooks kept{};
};

/// A mesh ready to be solved with these edge options: its ray-tracing structures, wedges, outlines of their faces, and
/// the rims that may be thin (none without `thin_plates`). Keeps a reference to `mesh`.
struct Target {
  Target(const TriangleMesh& mesh, const EdgeOptions& edges);
  Target(TriangleMesh&& mesh, const EdgeOptions& edges) = delete;
  const TriangleMesh& mesh;
  Tracer tracer;
  FaceTree faces;
  Convexity convexity;
  std::vector<Wedge> wedges;
  std::uint64_t wedges_enclosed;  // of these, marked so
  Outlines outlines;
  std::vector<ThinPlateEdge> rims;
  double min_wedge_angle;
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
