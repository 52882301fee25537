// The mechanisms of the list, each told by the room that computes it, and what one asks of another.
#pragma once

#include "plan/plan.h"
#include "solve/mechanisms/mechanism.h"
#include "utd/edge_sets.h"

namespace raytube {

/// Waves over curved surfaces (utd/surface).
MechanismEntry surface_waves_entry();
/// Whether they run in one band.
bool has_surface_waves(const SolvePlan& plan, const BandPlan& band);
/// The key that switches them on, as a remedy.
inline constexpr const char* more_surface_waves = "surfaces.waves = true, two to ten times the time of the tubes";

/// What these meet: sharp bends, points in which such bends meet, and tips of cones (utd/rounded, utd/tip).
MechanismEntry rounded_edges_entry();
MechanismEntry flat_tips_entry();
MechanismEntry round_tips_entry();

/// Fringe currents of edges, and what these start at further edges: between perfect conductors (utd/fringe, utd/multiple), and
/// beside other materials (utd/sheet, utd/impedance).
MechanismEntry edge_currents_entry();
MechanismState edge_currents_state(const SolvePlan& plan);
MechanismEntry material_edges_entry();

/// Waves along edges from corner to corner (utd/corner).
MechanismEntry plate_corners_entry();
MechanismEntry thin_ends_entry();
MechanismEntry solid_corners_entry();
/// The key that switches on edge currents, and what comes with them alone: edge-face interaction, waves over curved surfaces.
inline constexpr const char* more_edge_currents =
    "edges.method = \"fringe\", which takes several times as long where there are many edges";

/// Edge-face interaction (utd/interaction).
MechanismEntry interaction_entry();
/// Whether there is any in one band.
bool interacts(const SolvePlan& plan, const BandPlan& band);
/// Why pairs of an edge and a face are left out that might matter.
inline constexpr const char* beyond_budget = "beyond edges.between_budget";
/// Share of the squares expected of it that its budget must reach at a frequency; none if it is forced.
double least_reach_of_interaction(const SolvePlan& plan);
/// What edge-face interaction may take in a look at one frequency, the same in all of them: of the counted work
/// (utd/wedge/work.h) that tubes and edges of such a target take.
double interaction_work(const SolvePlan& plan);

/// A remedy that makes an omission less by no more than this share of its squares is not named, nor one that takes more than so
/// many times the time.
inline constexpr double worth_naming = 0.5, affordable = 10.0;
/// What makes tubes and waves meet curved surfaces in the place of their facets; empty: they do, where they may.
std::string remedy_of_flat_facets(const TubeOptions& tubes);

}  // namespace raytube
