// Steps of a solve that an image takes, too.
#pragma once

#include <optional>
#include <span>

#include "core/threads.h"
#include "mesh/features/smooth.h"
#include "solve/solve.h"
#include "utd/edge_sets.h"

namespace raytube {

/// Whether all antennas are at infinity; else none is.
bool all_far(const Sweep& sweep);

/// Whether every look's waves are plane enough all over the target for waves between surfaces, which know no others.
bool waves_are_plane(const TriangleMesh& mesh, const Sweep& sweep);

/// Throws InputError for an empty or non-physical sweep, or options out of range.
void check(const Sweep& sweep, const SolveOptions& options);

/// Throws InputError if the mesh is made of materials that the sweep has not.
void check_materials(const TriangleMesh& mesh, const Sweep& sweep);

/// Reciprocity: the true S of a monostatic look has S_vh = S_hv, so dropping our antisymmetric part brings S closer. One bounce
/// has none; several bounces have one out of their specular directions, fringe currents off their cone. A bistatic sweep is
/// left alone, also where it passes the monostatic direction: there the parts correct one another, and rows must not jump.
void make_reciprocal(std::span<ScatteringMatrix> scattering);

/// The curved surfaces that tubes see as such; none: all are flat facets.
std::optional<SmoothSurfaces> smooth_surfaces(const Target& target, const Sweep& sweep, const TubeOptions& tubes);

/// What a solve asks of the target's edges; all three arguments must outlive the EdgeSets made with it.
EdgeSetup edge_setup(const Target& target, const Sweep& sweep, const SolveOptions& options);

/// What quadrature of edge-face interaction may leave beside these tubes [m].
double interaction_tolerance(const TubeSums& tubes, const SolveOptions& options);

/// Whether a solve asks the edges for their currents.
bool edges_count(const EdgeSets& edges, const SolveOptions& options);

/// What waves between surfaces, of plane waves with their phase reference at the centre of the mesh, are times for antennas at a
/// finite distance.
Complex from_plane_waves(const TriangleMesh& mesh, const Look& look, const Radar& radar, double frequency);

/// Moves the phase reference from the centre of the mesh to the origin of its own coordinates, where that of antennas
/// lies.
Complex to_mesh_origin(const TriangleMesh& mesh, const Look& look, double frequency);

}  // namespace raytube
