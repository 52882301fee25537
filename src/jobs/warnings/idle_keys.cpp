#include "jobs/warnings/idle_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "case/data/names.h"
#include "plan/material_edges.h"
#include "plan/plan.h"

namespace raytube {

namespace {

using Reason = std::string;  // empty: the key has an effect

Reason why_not(std::string_view mechanism, const SolvePlan& plan) { return plan.state(mechanism).why_not; }

Reason no_currents(const SolvePlan& plan) {
  if (plan.fringe()) return {};
  return fmt::format("edges.method is \"{}\"", word_of(plan.edges.method));
}

Reason no_edges(const SolvePlan& plan) { return why_not("edges", plan); }

// A key that forbids what would not happen anyway has its effect.
Reason why_between(const SolvePlan& plan) { return plan.edges.interaction.possible() ? why_not("interaction", plan) : ""; }

Reason why_budget(const SolvePlan& plan) {
  if (plan.edges.interaction.possible() && plan.edges.interaction_budget == 0.0) return {};
  return why_not("interaction", plan);
}

Reason why_receiver_shadow(const SolvePlan& plan) {
  if (!plan.edges.receiver_shadow) return {};
  if (Reason why = no_edges(plan); !why.empty()) return why;
  return plan.sweep.bistatic ? "" : "looks are monostatic, and the receiver sees just what is lit";
}

Reason why_materials(const SolvePlan& plan) {
  return plan.fringe() && count_material_edges(plan.target, plan.sweep, plan.edges).known == 0
             ? "no edge of the target has a face of another material whose edges are known"
             : "";
}

struct KeyWithEffect {
  std::string_view key;
  Reason (*why_not)(const SolvePlan& plan);
};

// edges.method and edges.min_wedge_deg have an effect always, edges.utd_range_m is refused where it has none.
constexpr std::array<KeyWithEffect, 6> edge_keys = {{{"order", no_edges},
                                                     {"between", why_between},
                                                     {"between_budget", why_budget},
                                                     {"receiver_shadow", why_receiver_shadow},
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
  const bool meant = !plan.fringe() && turned_off_by_override(c);
  std::vector<std::string> sentences;
  for (const auto& [name, location, overriding] : c.edge_keys) {
    if (meant && !overriding) continue;
    if (const Reason why = why_idle(name, plan); !why.empty())
      sentences.push_back(fmt::format("{}: edges.{} has no effect: {}; leave the key out, or change that", location, name, why));
  }
  return sentences;
}

}  // namespace raytube
