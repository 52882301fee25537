// The scalar keys of a case that set options of the solver, each in one place. What reads a case, repeats it with its defaults,
// knows the names of keys, checks bounds, and compares the page on case keys walks these lists: visit(key, member).
#pragma once

#include "scene/keys/key.h"
#include "scene/options.h"

namespace raytube {

/// [tubes] and [accuracy].
template <class Tubes, class Visit>
void visit_tube_keys(Tubes& tubes, Visit&& visit) {
  constexpr std::string_view curved = "adaptive tubes; uniform ones see facets, so remove it",
                             refined = "adaptive tubes; uniform ones have the density given, so remove it";
  visit(CaseKey{"tubes.mode"}, tubes.mode);
  visit(CaseKey{"tubes.per_wavelength", a_density, "1/λ", "40; uniform: 10"},
        tubes.refines() ? tubes.max_per_wavelength : tubes.per_wavelength);
  visit(CaseKey{"tubes.max_bounces", {1, 1000}}, tubes.max_bounces);
  visit(CaseKey{.name = "tubes.curved", .allowed = tubes.refines(), .needs = curved, .choices = {"tubes.mode"}}, tubes.curved);
  visit(CaseKey{"tubes.skip"}, tubes.skip);
  visit(CaseKey{.name = "tubes.up", .unit = "mesh axes", .by_default = "−θ̂", .shown = tubes.up.has_value()}, tubes.up);
  visit(CaseKey{"accuracy.tolerance_db", above_zero, "dB", "", 1.0, tubes.refines(), refined, {"tubes.mode"}},
        tubes.tolerance_db);
  visit(CaseKey{"accuracy.model_share",
                {0, 1},
                "",
                "0.25; 0 where `accuracy.tolerance_db` is given",
                1.0,
                tubes.refines(),
                refined,
                {"tubes.mode"}},
        tubes.model_share);
}

/// [edges]; of targets of nothing but perfect conductors `has_materials` is false.
template <class Edges, class Wedges, class Visit>
void visit_edge_keys(Edges& edges, Wedges& wedges, bool has_materials, Visit&& visit) {
  constexpr std::string_view utd = "edges.method = \"utd\"; currents radiate to infinity, so remove it";
  visit(CaseKey{"edges.method"}, edges.method);
  visit(CaseKey{"edges.order", {1, 3}}, edges.order);
  visit(CaseKey{"edges.between"}, edges.interaction);
  visit(CaseKey{"edges.between_budget", at_least_zero}, edges.interaction_budget);
  visit(CaseKey{"edges.plate_corners"}, edges.corners.plates);
  visit(CaseKey{"edges.solid_corners"}, edges.corners.solids);
  visit(CaseKey{"edges.thin_ends"}, edges.corners.thin_ends);
  visit(CaseKey{"edges.receiver_shadow"}, edges.receiver_shadow);
  visit(CaseKey{"edges.thin_sheets"}, wedges.thin_plates);
  visit(CaseKey{"edges.min_wedge_deg", {.least = 0, .most = 180, .below = true}, "degrees", "", degree}, wedges.min_wedge_angle);
  visit(CaseKey{.name = "edges.materials", .shown = has_materials}, edges.materials);
  visit(CaseKey{"edges.utd_range_m",
                a_range,
                "m",
                "10 × 2D²/λ",
                1.0,
                edges.method == EdgeMethod::utd,
                utd,
                {"edges.method"},
                edges.utd_range != 0.0},
        edges.utd_range);
}

/// [surfaces].
template <class Surfaces, class Visit>
void visit_surface_keys(Surfaces& surfaces, Visit&& visit) {
  visit(CaseKey{"surfaces.waves"}, surfaces.waves);
  visit(CaseKey{"surfaces.rounded_edges"}, surfaces.rounded_edges);
  visit(CaseKey{"surfaces.flat_tips"}, surfaces.flat_tips);
  visit(CaseKey{"surfaces.round_tips"}, surfaces.round_tips);
}

}  // namespace raytube
