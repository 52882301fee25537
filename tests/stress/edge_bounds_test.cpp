// Edge currents of bodies with details far below the wavelength: bounded by the size of the body, and no cliff beside any of
// them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run.h"
#include "solve/look_solver.h"
#include "solve/physical_bound.h"
#include "stress/fine_bodies.h"
#include "stress/stability.h"

namespace raytube::testing {
namespace {

constexpr int looks_of_a_body = 4;
constexpr int interaction_every = 5;   // bodies: with edge-face interaction and images in right-angled corners, too
constexpr double displacement = 1e-6;  // [wavelengths] of each corner: less than any detail that a wave could tell
// S is a length: of bodies that are hardly larger than the displacement itself, wires of some of it, it may change by a hundred
// times as much as that, a ten thousandth of a wavelength.
constexpr double least_bound = 100 * displacement / 0.01;

SolveOptions with_order(int order, bool interaction) {
  SolveOptions result;
  result.threads = 1;
  result.tubes.max_bounces = 2;
  result.edges.order = order;
  result.edges.interaction = interaction;
  result.keep_parts = true;
  return result;
}

struct Solved {
  SweepResult result;
  std::vector<PhysicalBound> bounds;  // of each look
};

Solved solve_body(const PolygonSoup& soup, const Sweep& sweep, const SolveOptions& options) {
  const Target target(build_mesh(soup, 1.0).mesh);
  const SolvePlan plan(target, sweep, options);
  const PhysicalBounds bounds(plan, LookSolver(plan).edge_lengths());
  Solved solved{solve(plan), {}};
  for (const Look& look : sweep.looks) solved.bounds.push_back(bounds.of(look, 0));
  return solved;
}

double sum(const PhysicalBound& bound) {
  return bound.first_bounce + bound.later_bounces + bound.limits.edges + (bound.limits.edge_order - 1) * bound.limits.edges;
}

struct Worst {
  double share = 0.0;
  std::string where;

  void take(double value, const std::string& here) {
    if (value <= share) return;
    share = value;
    where = here;
  }
};

// The bound is derived in docs/theory/bounds.md.
TEST(EdgeBounds, NoBodyBeyondItsBoundAndNoCliff) {
  FineBodies bodies(20261123);
  Worst first, higher, change;
  std::uint64_t beyond = 0, cliffs = 0;
  const int count = size_of_run(150, 5000);
  for (int b = 0; b < count; ++b) {
    const FineBody body = bodies.next();
    std::vector<Direction> directions;
    for (int i = 0; i < looks_of_a_body; ++i) directions.push_back({std::acos(bodies.number(-1, 1)), bodies.number(0, 2 * pi)});
    const Sweep sweep = monostatic(directions, speed_of_light);
    const PolygonSoup moved = bodies.moved(body.soup, displacement);
    for (const int order : {1, 2, 3}) {
      const SolveOptions options = with_order(order, b % interaction_every == 0);
      const Solved here = solve_body(body.soup, sweep, options), there = solve_body(moved, sweep, options);
      for (const BeyondBound& part : here.result.statistics.beyond_bound) {
        beyond += part.rows;
        ADD_FAILURE() << body.kind << " " << b << ", order " << order << ": " << part.part << " " << part.ratio
                      << " times its bound";
      }
      for (std::size_t i = 0; i < directions.size(); ++i) {
        const std::string name = fmt::format("{} {}, order {}, look {}", body.kind, b, order, i);
        const PhysicalBound& bound = here.bounds[i];
        ASSERT_TRUE(std::isfinite(frobenius_norm(here.result.total[i]))) << name;
        first.take(largest_amplitude(here.result.of("edges_order_1")[i]) / bound.limits.edges, name);
        if (order > 1)
          higher.take(
              largest_amplitude(here.result.of("edges_order_2_on")[i]) / (bound.limits.edge_order - 1) * bound.limits.edges,
              name);
        const double change_here = largest_amplitude(here.result.total[i] - there.result.total[i]);
        const double share = change_here / std::max({sum(bound), sum(there.bounds[i]), least_bound});
        if (share > 0.01) fmt::print("cliff of {:.2g} at {}\n", share, name);
        cliffs += share > 0.01 ? 1 : 0;
        change.take(share, name);
      }
    }
  }
  EXPECT_EQ(beyond, 0u);
  EXPECT_LT(change.share, 0.01) << change.where;
  fmt::print("bodies x looks {}: edges at most {:.2g} of their bound ({}), higher orders {:.2g} ({}); change {:.2g} ({})\n",
             count * looks_of_a_body, first.share, first.where, higher.share, higher.where, change.share, change.where);
}

}  // namespace
}  // namespace raytube::testing
