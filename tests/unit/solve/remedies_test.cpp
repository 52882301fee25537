// Remedies say what they cost, and are named only where they help.
#include "solve/remedies.h"

#include <gmock/gmock.h>

#include "shapes.h"
#include "solve/mechanisms/list.h"

namespace raytube {
namespace {

using ::testing::StartsWith;

const Target& small_target() {
  static const Target target(build_mesh(shapes::dihedral(0.2, 0.2), 1.0).mesh, {});
  return target;
}

// More pairs of an edge and a face than a budget reaches.
const Target& many_faces() {
  static const Target target(build_mesh(shapes::icosphere(2, 0.3), 1.0).mesh, {.min_wedge_angle = 1.0 * degree});
  return target;
}

// What a solve has shown, with a budget of 4.
struct Solve {
  std::uint64_t pairs_left_out = 0;
  TruncatedSums truncated{};
  std::uint64_t pairs = 0;
  double left_out = 1.0;
  std::vector<std::uint64_t> hits{};
  TubeOptions tubes{};
  SurfaceOptions surfaces{};
  bool materials = false, sheets = false;
  double curved_edges = 0.0;
  const Target& target = small_target();

  std::string remedy(Omission omission, const EdgeOptions& edges = {}) const {
    Sweep sweep{{10e9}, {{{1.0, 0.2}, {1.0, 0.2}}}};
    if (materials) sweep.materials.resize(1);
    if (sheets) sweep.materials[0].kind = MaterialKind::thin_sheet;
    const SolvePlan plan(target, sweep, {tubes, edges, surfaces});
    Statistics statistics;
    statistics.truncated = truncated, statistics.hits = hits;
    const std::vector<Count> counts{{.what = "interaction_pairs", .count = pairs},
                                    {"pairs of edge and face", beyond_budget, pairs_left_out}};
    return remedy_of(omission, plan, statistics,
                     std::vector<MechanismShown>(plan.mechanisms.size(), {counts, 0, left_out, curved_edges}));
  }
};

// All pairs at twice the budget: 9 parts of work in the place of 5.
TEST(Remedies, ABudgetThatCanBeHadComesWithItsCost) {
  Solve solve{100, {}, 100};
  EXPECT_EQ(solve.remedy(Omission::interaction), "edges.between_budget = 8, about 1.8 times the time");
}

TEST(Remedies, ABudgetThatCannotBeHadIsNotNamed) {
  Solve solve{3'900'000'000, {}, 5000};
  EXPECT_THAT(solve.remedy(Omission::interaction), StartsWith("none; use a full-wave method"));
  solve.pairs = 0;  // not even the first
  EXPECT_THAT(solve.remedy(Omission::interaction), StartsWith("none; use a full-wave method"));
}

TEST(Remedies, ABudgetIsNotNamedWhereItIsNotWhatIsMissing) {
  Solve solve{100, {}, 100, 0.1};
  EXPECT_THAT(solve.remedy(Omission::interaction), StartsWith("none; use a full-wave method"));
}

TEST(Remedies, InteractionThatIsSwitchedOff) {
  EXPECT_EQ(Solve{}.remedy(Omission::interaction, {.interaction = false}), "edges.between = true, at most 5 times the time");
  const Solve vehicle{.target = many_faces()};
  EXPECT_THAT(vehicle.remedy(Omission::interaction, {.interaction = false}), StartsWith("none; use a full-wave method"));
}

// Half of the meetings are those of the last bounce.
TEST(Remedies, MoreBounces) {
  Solve solve;
  solve.truncated[Truncation::bounces] = {1, 1.0};
  solve.hits = {50, 50};
  EXPECT_EQ(solve.remedy(Omission::cut_tubes), "tubes.max_bounces = 16, at most 5 times the time of the tubes");
}

// Whatever edges.method switches off comes back with it: currents and, with them, orders, interaction and waves over surfaces.
TEST(Remedies, EdgeCurrentsThatAreSwitchedOff) {
  for (const EdgeMethod method : {EdgeMethod::none, EdgeMethod::utd})
    for (const Omission omission : {Omission::edges, Omission::corners, Omission::interaction, Omission::smooth_surfaces})
      EXPECT_THAT(Solve{}.remedy(omission, {.method = method, .interaction = {}}), StartsWith("edges.method = \"fringe\", "))
          << text_of(omission).name;
  const Solve sheets{.materials = true, .sheets = true};  // which end waves of edges
  EXPECT_THAT(sheets.remedy(Omission::interaction, {.method = EdgeMethod::none, .interaction = {}}), StartsWith("none"));
  const Solve coated{.materials = true};  // waves run over conductors alone
  EXPECT_THAT(coated.remedy(Omission::smooth_surfaces, {.method = EdgeMethod::none, .interaction = {}}), StartsWith("none"));
}

TEST(Remedies, EdgesOfMaterialsThatAreSwitchedOff) {
  const Solve coated{.materials = true};
  EdgeOptions without;
  without.materials = MaterialEdgeMethod::none;
  EXPECT_THAT(coated.remedy(Omission::edges, without), StartsWith("edges.materials = "));
  EXPECT_THAT(coated.remedy(Omission::edges), StartsWith("none"));
}

TEST(Remedies, SurfaceWavesThatAreSwitchedOff) {
  Solve solve{.surfaces = {.waves = false}};
  EXPECT_THAT(solve.remedy(Omission::smooth_surfaces), StartsWith("surfaces.waves = true, "));
  // Beside curved faces edge currents follow these with them.
  EXPECT_THAT(solve.remedy(Omission::edges), StartsWith("none"));
  solve.curved_edges = 1.0;
  EXPECT_THAT(solve.remedy(Omission::edges), StartsWith("surfaces.waves = true, "));
  EXPECT_THAT(Solve{}.remedy(Omission::smooth_surfaces), StartsWith("none"));
}

TEST(Remedies, FacetsThatAreMeant) {
  Solve flat, uniform, curved;
  flat.tubes.curved = CurvedSurfaces::never;
  uniform.tubes.mode = TubeMode::uniform;
  curved.tubes.curved = CurvedSurfaces::always;
  for (const Omission omission : {Omission::facets, Omission::smooth_surfaces}) {
    EXPECT_THAT(flat.remedy(omission), StartsWith("tubes.curved = \"convex\", "));
    EXPECT_THAT(uniform.remedy(omission), StartsWith("tubes.mode = \"adaptive\", "));
  }
  EXPECT_EQ(curved.remedy(Omission::facets), "a finer mesh");
}

TEST(Remedies, MoreOrders) {
  EXPECT_THAT(Solve{}.remedy(Omission::edge_orders, {.order = 2, .interaction = {}}), StartsWith("edges.order = 3, "));
  EXPECT_THAT(Solve{}.remedy(Omission::corners, {.order = 1, .interaction = {}}), StartsWith("edges.order = 2, "));
  EXPECT_THAT(Solve{}.remedy(Omission::corners), StartsWith("none"));
}

TEST(Remedies, ReadAsSentences) {
  for (std::size_t i = 0; i < omissions; ++i)
    EXPECT_EQ(Solve{}.remedy(static_cast<Omission>(i)).find("none:"), std::string::npos) << i;
}

}  // namespace
}  // namespace raytube
