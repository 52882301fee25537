#include "jobs/warnings/idle_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "case/data/names.h"
#include "scene/skipped.h"

namespace raytube {

namespace {

using Reason = std::string;  // empty: the key has an effect

constexpr const char* no_edge = "the target has no convex edge between perfect conductors";

Reason no_currents(const SolvePlan& plan) {
  if (plan.mechanisms.fringe) return {};
  return fmt::format("edges.method is \"{}\"", edge_method_name(plan.edges.method));
}

Reason no_edges(const SolvePlan& plan) {
  if (Reason why = no_currents(plan); !why.empty()) return why;
  return std::ranges::any_of(plan.target.wedges, &Wedge::radiates) ? "" : no_edge;
}

Reason no_interaction(const SolvePlan& plan) {
  if (Reason why = no_edges(plan); !why.empty()) return why;
  if (plan.convexity.no_reflection) return nothing_in_front;
  if (plan.skips.material_looks > 0) return "not all of the target is a perfect conductor";
  if (plan.skips.near_looks > 0) return "antennas are too close for plane waves";
  if (plan.edges.interaction_budget == 0.0) return "edges.between_budget is 0";
  if (plan.skips.frequencies_without_large == plan.sweep.frequencies.size())
    return "no edge is as long as a wavelength, or no face as wide";
  return {};
}

Reason why_between(const SolvePlan& plan) { return plan.edges.interaction.possible() ? no_interaction(plan) : ""; }

Reason why_budget(const SolvePlan& plan) {
  if (!plan.edges.interaction.possible()) return "edges.between is false";
  return plan.edges.interaction_budget == 0.0 ? "" : no_interaction(plan);
}

Reason why_receiver_shadow(const SolvePlan& plan) {
  if (!plan.edges.receiver_shadow) return {};
  if (Reason why = plan.mechanisms.material_edges ? no_currents(plan) : no_edges(plan); !why.empty()) return why;
  return plan.sweep.bistatic ? "" : "looks are monostatic, and the receiver sees just what is lit";
}

Reason why_transition(const SolvePlan& plan) {
  if (Reason why = no_edges(plan); !why.empty()) return why;
  return plan.edges.order == 1 ? "edges.order is 1, and it matters at 2 and 3 only" : "";
}

Reason why_materials(const SolvePlan& plan) {
  const auto other = [](const Wedge& wedge) { return wedge.stands_alone() && !wedge.conducting(); };
  const bool has_effect = !plan.mechanisms.material_edges || std::ranges::any_of(plan.target.wedges, other);
  return has_effect ? "" : "no edge of the target has a face of another material than a perfect conductor";
}

struct KeyWithEffect {
  std::string_view key;
  Reason (*why_not)(const SolvePlan& plan);
};

// edges.method and edges.min_wedge_deg have an effect always, edges.utd_range_m is refused where it has none.
constexpr std::array<KeyWithEffect, 7> edge_keys = {{{"order", no_edges},
                                                     {"between", why_between},
                                                     {"between_budget", why_budget},
                                                     {"receiver_shadow", why_receiver_shadow},
                                                     {"transition", why_transition},
                                                     {"materials", why_materials},
                                                     {"thin_sheets", no_currents}}};

Reason why_idle(const std::string& key, const SolvePlan& plan) {
  const auto known = std::ranges::find(edge_keys, key, &KeyWithEffect::key);
  return known == edge_keys.end() ? "" : known->why_not(plan);
}

bool turned_off_by_override(const Case& c) {
  return std::ranges::any_of(c.edge_keys, [](const WrittenKey& key) { return key.name == "method" && key.overriding; });
}

}  // namespace

std::vector<std::string> idle_key_warnings(const Case& c, const SolvePlan& plan) {
  const bool meant = !plan.mechanisms.fringe && turned_off_by_override(c);
  std::vector<std::string> sentences;
  for (const auto& [name, location, overriding] : c.edge_keys) {
    if (meant && !overriding) continue;
    if (const Reason why = why_idle(name, plan); !why.empty())
      sentences.push_back(fmt::format("{}: edges.{} has no effect: {}; leave the key out, or change that", location, name, why));
  }
  return sentences;
}

}  // namespace raytube
