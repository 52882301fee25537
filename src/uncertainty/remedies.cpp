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

std::string remedy_of_edges(const RemedyEvidence& evidence) {
  if (evidence.edges.method == EdgeMethod::none)
    return "edges.method = \"fringe\", which takes several times as long where there are many edges";
  if (evidence.materials && evidence.edges.materials == MaterialEdgeMethod::none)
    return "edges.materials = \"luebbers\", at almost no cost";
  return "none; use a full-wave method where such edges matter";
}

// At most: where there is little to compute it takes less than it may.
std::string up_to_budget(const char* key, double budget) {
  return fmt::format("{}, at most {:.2g} times the time", key, 1.0 + budget);
}

// The budget for all pairs, taken to cost as much each as those that were computed: these are the strongest, and so not the
// cheapest. A look that leaves pairs out has spent its budget.
std::string larger_budget(double budget, const RemedyEvidence& evidence) {
  const SkipCounts& skips = evidence.skips;
  const std::uint64_t left = skips.pairs_beyond_budget + skips.reflections_beyond_budget + skips.fringe_beyond_budget;
  if (left == 0 || evidence.interaction_pairs == 0 || evidence.interaction_left_out < worth_naming) return no_interaction;
  const double needed = std::ceil(budget * (1.0 + static_cast<double>(left) / static_cast<double>(evidence.interaction_pairs)));
  const double factor = (1.0 + needed) / (1.0 + budget);
  if (factor > affordable) return no_interaction;
  return fmt::format("edges.between_budget = {:.0f}, {}", needed, times_the_time(factor));
}

std::string remedy_of_interaction(const RemedyEvidence& evidence) {
  const double budget = evidence.edges.interaction_budget, usual = EdgeOptions{}.interaction_budget;
  if (evidence.edges.method != EdgeMethod::fringe) return no_interaction;
  const bool is_off = !evidence.edges.interaction.possible() || budget == 0.0;
  if (is_off && evidence.possible_pairs > few_pairs) return no_interaction;
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

}  // namespace

std::string remedy_of(Omission omission, const RemedyEvidence& evidence) {
  if (omission == Omission::edges) return remedy_of_edges(evidence);
  if (omission == Omission::interaction) return remedy_of_interaction(evidence);
  if (omission == Omission::cut_tubes) return remedy_of_cut_tubes(evidence);
  if (omission == Omission::smooth_surfaces && evidence.looks_without_waves > 0)
    return "surfaces.waves = true, two to ten times the time of the tubes";
  if (omission == Omission::edge_orders && evidence.edges.order < 3)
    return "edges.order = 3, several times the time of the edges";
  return text_of(omission).remedy;
}

}  // namespace raytube
