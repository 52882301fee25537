#include "uncertainty/remedies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace raytube {

namespace {

constexpr double affordable = 10.0;   // times the time, at most
constexpr double worth_naming = 0.5;  // of the squares of a part, at least
constexpr double few_pairs = 1e4;     // of an edge and a face: of more than these the budget reaches too few
constexpr const char* no_interaction = "none; use a full-wave method where faces see one another";

std::string times_the_time(double factor) { return fmt::format("about {:.2g} times the time", factor); }

// Edge currents, and what comes with them alone: edge-face interaction, waves over curved surfaces.
constexpr const char* edge_currents = "edges.method = \"fringe\", which takes several times as long where there are many edges";
constexpr const char* surface_waves = "surfaces.waves = true, two to ten times the time of the tubes";

bool has_edge_currents(const RemedyEvidence& evidence) { return evidence.edges.method == EdgeMethod::fringe; }

std::string remedy_of_edges(const RemedyEvidence& evidence) {
  if (!has_edge_currents(evidence)) return edge_currents;
  if (evidence.materials && evidence.edges.materials == MaterialEdgeMethod::none)
    return "edges.materials = \"fringe\", at little cost";
  const bool straight_over_curved = !evidence.surfaces.waves.possible() && evidence.curved_edges > worth_naming;
  if (straight_over_curved && !evidence.materials) return surface_waves;
  return "none; use a full-wave method where such edges matter";
}

// At most: where there is little to compute it takes less than it may.
std::string up_to_budget(const char* key, double budget) {
  return fmt::format("{}, at most {:.2g} times the time", key, 1.0 + budget);
}

// The budget for all pairs, taken to cost as much each as those that were computed: these are the strongest, and so not the
// cheapest. A look that leaves pairs out has spent its budget.
std::string larger_budget(double budget, const RemedyEvidence& evidence) {
  const std::uint64_t left = evidence.pairs_left_out;
  if (left == 0 || evidence.interaction_pairs == 0 || evidence.interaction_left_out < worth_naming) return no_interaction;
  const double needed = std::ceil(budget * (1.0 + static_cast<double>(left) / static_cast<double>(evidence.interaction_pairs)));
  const double factor = (1.0 + needed) / (1.0 + budget);
  if (factor > affordable) return no_interaction;
  return fmt::format("edges.between_budget = {:.0f}, {}", needed, times_the_time(factor));
}

std::string remedy_of_interaction(const RemedyEvidence& evidence) {
  const double budget = evidence.edges.interaction_budget, usual = EdgeOptions{}.interaction_budget;
  if (evidence.sheets) return no_interaction;
  const bool is_off = !has_edge_currents(evidence) || !evidence.edges.interaction.possible() || budget == 0.0;
  if (is_off && evidence.possible_pairs > few_pairs) return no_interaction;
  if (!has_edge_currents(evidence)) return edge_currents;
  if (!evidence.edges.interaction.possible()) return up_to_budget("edges.between = true", budget);
  if (budget == 0.0) return up_to_budget(fmt::format("edges.between_budget = {}", usual).c_str(), usual);
  return larger_budget(budget, evidence);
}

// Twice as many bounces, each as dear as the last one: later ones lose tubes.
std::string more_bounces(int bounces, const std::vector<std::uint64_t>& hits) {
  const double all = std::accumulate(hits.begin(), hits.end(), 0.0);
  const double last = hits.empty() ? 0.0 : static_cast<double>(hits.back());
  const double factor = all > 0.0 ? 1.0 + bounces * last / all : 2.0;
  return fmt::format("tubes.max_bounces = {}, at most {:.2g} times the time of the tubes", 2 * bounces, factor);
}

std::string remedy_of_cut_tubes(const RemedyEvidence& evidence) {
  const TruncatedSums& truncated = evidence.truncated;
  if (truncated[Truncation::bounces].sigma >= truncated[Truncation::width].sigma)
    return more_bounces(evidence.tubes.max_bounces, evidence.hits);
  return fmt::format("tubes.per_wavelength = {:.3g}, up to 4 times the time of the tubes",
                     2.0 * evidence.tubes.max_per_wavelength);
}

// The order beyond which the part no longer falls: corners are where a face of the next edge ends.
int best_order(Omission omission) { return omission == Omission::corners ? 2 : 3; }

std::string remedy_of_order(Omission omission, const RemedyEvidence& evidence) {
  if (!has_edge_currents(evidence)) return edge_currents;
  if (evidence.edges.order >= best_order(omission)) return text_of(omission).remedy;
  return fmt::format("edges.order = {}, a few times the time of the edges", best_order(omission));
}

// What makes tubes and waves meet curved surfaces in the place of their facets; empty: they do, where they may.
std::string remedy_of_flat_facets(const TubeOptions& tubes) {
  if (tubes.mode == TubeMode::uniform) return "tubes.mode = \"adaptive\", often less time";
  if (tubes.curved == CurvedSurfaces::never) return "tubes.curved = \"convex\", about the same time";
  return "";
}

std::string remedy_of_smooth_surfaces(const RemedyEvidence& evidence) {
  const std::string none = text_of(Omission::smooth_surfaces).remedy, facets = remedy_of_flat_facets(evidence.tubes);
  if (evidence.materials) return none;
  if (!has_edge_currents(evidence)) return edge_currents;
  if (!evidence.surfaces.waves.possible()) return surface_waves;
  if (!facets.empty()) return facets;
  return evidence.looks_without_waves > 0 ? surface_waves : none;
}

std::string remedy_of_facets(const TubeOptions& tubes) {
  if (const std::string remedy = remedy_of_flat_facets(tubes); !remedy.empty()) return remedy;
  return tubes.curved == CurvedSurfaces::always ? "a finer mesh" : text_of(Omission::facets).remedy;
}

}  // namespace

std::string remedy_of(Omission omission, const RemedyEvidence& evidence) {
  switch (omission) {
    case Omission::corners:
    case Omission::edge_orders:
      return remedy_of_order(omission, evidence);
    case Omission::edges:
      return remedy_of_edges(evidence);
    case Omission::interaction:
      return remedy_of_interaction(evidence);
    case Omission::smooth_surfaces:
      return remedy_of_smooth_surfaces(evidence);
    case Omission::facets:
      return remedy_of_facets(evidence.tubes);
    case Omission::cut_tubes:
      return remedy_of_cut_tubes(evidence);
    default:
      return text_of(omission).remedy;
  }
}

}  // namespace raytube
