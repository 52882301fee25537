// A new mechanism is one room and one entry of the list: this one, whose edges shine with a constant brightness, has a column, a
// switch, a cost, a bound, counts, pieces in an image, and a place in what is kept of a look, without a line elsewhere.
#include "solve/mechanisms/mechanism.h"

#include <gtest/gtest.h>

#include "run.h"
#include "shapes.h"
#include "solve/image.h"
#include "solve/look_solver.h"
#include "solve/mechanisms/band_scene.h"
#include "solve/memory.h"
#include "solve/solve.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double brightness = 0.01;  // of |S| to the metre
constexpr double frequency = 10e9;

class ShiningEdges : public Mechanism {
 public:
  explicit ShiningEdges(const BandScene& scene) : scene_(scene) {}

  Prospect prospect(const TracedLook&) const override { return {}; }

  Contribution solve(const TracedLook&, const std::vector<bool>& wanted, LookSink& sink) const override {
    ScatteringMatrix all;
    for (const Wedge& wedge : scene_.plan.target.wedges) {
      ScatteringMatrix s;
      s.at(0, 0) = s.at(1, 1) = brightness * glm::distance(wedge.start, wedge.end);
      if (sink.image) sink.image->pieces.push_back({wedge.start, wedge.end, s});
      all += s;
    }
    const std::size_t edges = scene_.plan.target.wedges.size();
    return {.s = {std::vector<ScatteringMatrix>(wanted.size(), all)},
            .work = 10.0 * static_cast<double>(edges),
            .counts = {{.what = "shining_edges", .count = edges, .fold = Fold::most}, {"edges", "too dark to shine", 2}}};
  }

 private:
  const BandScene& scene_;
};

MechanismState state(const SolvePlan& plan) {
  return plan.edges.order == 1 ? without("edges.order is 1") : MechanismState{.on = true, .forced = true, .what = "all edges"};
}

std::vector<MechanismEntry> with_shining_edges(double (*bound)(const AmplitudeLimits&)) {
  std::vector<MechanismEntry> list = mechanism_list();
  list.push_back({.name = "shine",
                  .label = "shining edges",
                  .key = "edges.order",
                  .budget_key = nullptr,
                  .columns = {{"shine", "shining edges (edges.order)", bound}},
                  .counts = {"shining_edges"},
                  .state = state,
                  .make = [](const BandScene& scene) -> std::unique_ptr<Mechanism> {
                    return state(scene.plan).on ? std::make_unique<ShiningEdges>(scene) : nullptr;
                  },
                  .bytes = [](const SolvePlan&) { return 1e6; }});
  return list;
}

double edges_of_box(const std::array<double, 3>& sides) { return 4.0 * (sides[0] + sides[1] + sides[2]); }

struct Shining {
  Target target{build_mesh(shapes::box({0.3, 0.2, 0.1}), 1.0).mesh};
  Sweep sweep = monostatic({{1.1, 0.4}, {0.7, 0.9}}, frequency);
  SolveOptions options = testing::options(EdgeMethod::fringe);
  const double expected = brightness * edges_of_box({0.3, 0.2, 0.1});

  Shining() { options.keep_parts = true; }
  SolvePlan plan(double (*bound)(const AmplitudeLimits&) = [](const AmplitudeLimits& limits) { return limits.edges; }) const {
    return SolvePlan(target, sweep, options, {}, with_shining_edges(bound));
  }
};

TEST(MechanismList, ANewOneHasItsColumnAndItsCounts) {
  const Shining shining;
  const SweepResult with = solve(shining.plan()), without = solve(shining.target, shining.sweep, shining.options);
  for (std::size_t row = 0; row < shining.sweep.rows(); ++row) {
    EXPECT_NEAR(std::abs(with.of("shine")[row].vv()), shining.expected, 1e-12);
    EXPECT_LT(frobenius_norm(with.total[row] - without.total[row] - with.of("shine")[row]), 1e-12);
  }
  EXPECT_EQ(with.statistics.counted("shining_edges"), 24u);  // in two looks
  const auto left_out = std::ranges::find(with.statistics.skipped, "too dark to shine", &Skipped::why);
  ASSERT_NE(left_out, with.statistics.skipped.end());
  EXPECT_EQ(left_out->count, 4u);
  const MechanismUse& use = with.statistics.mechanisms.back();
  EXPECT_EQ(use.name, "shine");
  EXPECT_EQ(use.looks, 2u);
  EXPECT_TRUE(with.statistics.beyond_bound.empty());
}

TEST(MechanismList, ANewOneHasASwitchACostAndABound) {
  Shining shining;
  const SweepResult beyond = solve(shining.plan([](const AmplitudeLimits&) { return 1e-6; }));
  ASSERT_EQ(beyond.statistics.beyond_bound.size(), 1u);
  EXPECT_EQ(beyond.statistics.beyond_bound[0].part, "shining edges (edges.order)");
  const auto bytes = [](const SolvePlan& plan) { return bytes_of(estimate_memory(plan), MemoryOf::program); };
  const SolvePlan none(shining.target, shining.sweep, shining.options);
  EXPECT_EQ(bytes(shining.plan()), bytes(none) + 1e6);
  shining.options.edges.order = 1;
  const SweepResult off = solve(shining.plan());
  EXPECT_EQ(off.statistics.mechanisms.back().why_not, "edges.order is 1");
  EXPECT_EQ(frobenius_norm(off.of("shine")[0]), 0.0);
}

TEST(MechanismList, ANewOneHasPiecesInAnImageAndIsKept) {
  const Shining shining;
  const SolvePlan plan = shining.plan();
  const LookSolver solver(plan);
  Progress none({});
  const LookResult look = solver.solve(0, none, 1.0);
  const auto again = look_of_bytes(look_bytes(look), 1, plan.mechanisms.size());
  ASSERT_TRUE(again);
  EXPECT_FALSE(look_of_bytes(look_bytes(look), 1, mechanism_list().size()));
  EXPECT_EQ(count_named(again->mechanisms.back().counts, "shining_edges"), 12u);
  const LookImage with = image_of_look(plan, 0, 4.0),
                  without = image_of_look(shining.target, shining.sweep, shining.options, 0, 4.0);
  ScatteringMatrix more;
  for (const ImageEdge& edge : with.edges) more += edge.s;
  for (const ImageEdge& edge : without.edges) more = more - edge.s;
  EXPECT_NEAR(std::abs(more.vv()), shining.expected, 1e-9);
}

}  // namespace
}  // namespace raytube
