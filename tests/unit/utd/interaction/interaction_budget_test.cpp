// What edge-face interaction may cost: bounds of pairs, work counted, what is left out and told.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "interaction_bodies.h"
#include "solve/look_solver.h"
#include "solve/mechanisms/list.h"
#include "utd/interaction/edge_face_interaction.h"
#include "utd/interaction/illuminated_faces.h"
#include "utd/interaction/interaction_groups.h"

namespace raytube::testing::interaction {
namespace {

double largest(const ScatteringMatrix& s) {
  double most = 0.0;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) most = std::max(most, std::abs(s.at(p, q)));
  return most;
}

/// A square plate of 2 wavelengths, and a rectangle anywhere near it.
PolygonSoup plate_and_another(std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto vector = [&] { return dvec3(any(random), any(random), any(random)); };
  PolygonSoup soup{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2, 3}, {4, 5, 6, 7}}};
  const dvec3 side = glm::normalize(vector()), other = glm::normalize(glm::cross(side, vector()));
  const dvec3 middle = 4.0 * vector(), a = (0.6 + std::abs(any(random))) * side, b = (0.6 + std::abs(any(random))) * other;
  for (const dvec3& corner : {-a - b, a - b, a + b, -a + b}) soup.points.push_back(middle + corner);
  for (dvec3& point : soup.points) point *= lambda;
  return soup;
}

Look any_look(std::mt19937& random) {
  std::uniform_real_distribution<double> theta(0.1, pi - 0.1), phi(-pi, pi);
  return {{theta(random), phi(random)}, {theta(random), phi(random)}};
}

// Boxes side by side: more pairs than a body of few parts has.
PolygonSoup boxes(int count, double side) {
  PolygonSoup all;
  for (int i = 0; i < count; ++i) {
    PolygonSoup box =
        shapes::box(side * dvec3(1.0 + 0.031 * i, 1.0 - 0.017 * i, 1.0 + 0.011 * i));  // all come where some are equal
    const auto first = static_cast<std::uint32_t>(all.points.size());
    for (const dvec3& p : box.points)
      all.points.push_back(p + dvec3(1.7 * side * (i % 4), 1.7 * side * (i / 4), 0.3 * side * (i % 3)));
    for (auto polygon : box.polygons) {
      for (std::uint32_t& corner : polygon) corner += first;
      all.polygons.push_back(polygon);
    }
  }
  return all;
}

std::uint64_t skipped(const SweepResult& result, const std::string& what, const std::string& why) {
  for (const Skipped& item : result.statistics.skipped)
    if (item.what == what && item.why.starts_with(why)) return item.count;
  return 0;
}

// Equal edges over equal faces, and one pair of larger ones.
struct Pairs {
  explicit Pairs(const PolygonSoup& soup) : target(build_mesh(soup, 1.0).mesh), parts(target.mesh, target.wedges, {}, 1.0) {}
  PairPlan plan(double pairs) const {
    return {{parts.axes, 0.0, target.mesh, parts.patches, parts.by_area}, pairs * work_of_pair(parts.by_area.size())};
  }
  Target target;
  InteractionParts parts;
};

TEST(PairPlan, TakesTheStrongestAndEqualsTogether) {
  const Pairs body(two_boxes(2 * lambda, lambda));
  const PairPlan none = body.plan(0.9), all = body.plan(1e4);
  EXPECT_EQ(none.pairs(), 0u);
  EXPECT_EQ(none.reach(), 0.0);
  EXPECT_EQ(all.left_out(), 0u);
  EXPECT_EQ(all.reach(), 1.0);
  double before = 0.0;
  for (const double wanted : {2.0, 8.0, 20.0, 50.0}) {
    const PairPlan some = body.plan(wanted);
    EXPECT_EQ(some.pairs() + some.left_out(), all.pairs());
    EXPECT_EQ(some.pairs() % 2, 0u);  // the boxes are mirror images of one another
    EXPECT_LE(static_cast<double>(some.pairs()), 2.0 * wanted);
    EXPECT_GE(some.reach(), before);
    EXPECT_GE(some.reach() * static_cast<double>(all.pairs()), static_cast<double>(some.pairs()));
    before = some.reach();
  }
}

// A square of 2 over an edge of its size, one side above its middle: the solid angle is 4 asin(1 / 2) there.
TEST(PairPlan, WhatIsExpectedGoesWithTheSolidAngle) {
  const Pairs body({{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-0.01, -0.5, 1}, {0.01, -0.5, 1}, {0, 0.5, 1}},
                    {{0, 1, 2, 3}, {4, 5, 6}}});
  const auto longest = std::ranges::max_element(body.parts.axes, {}, [&](const EdgeAxis& axis) {
    return axis.wedge->faces[0].patch == body.parts.by_area[0] ? 0.0 : axis.length;
  });
  const std::uint32_t patch = body.parts.by_area[0];
  const double expected = expected_of_pair(*longest, body.target.mesh, patch, body.parts.patches[patch]);
  EXPECT_NEAR(expected, longest->length * 4 * std::asin(0.5) / (32 * pi * pi * pi), 0.2 * expected);
}

// Four boxes: with next to no work it is not begun, with all it needs it is what it is when forced, and forced it does what can
// be had of too little.
TEST(InteractionReach, LessThanHalfIsNone) {
  const Target target(build_mesh(boxes(4, 1.2 * lambda), 1.0).mesh);
  const auto solved = [&](Use use, double budget) {
    SolveOptions o = adaptive(true, 2);
    o.edges.interaction = use;
    o.edges.interaction_budget = budget;
    return solve(target, monostatic({{70 * degree, 25 * degree}}, frequency), o);
  };
  const char* looks = "looks without edge-face interaction";
  const char* why = "edges.between_budget reaches less than half";
  const SweepResult poor = solved({}, 0.01), forced = solved(true, 0.01), without = solved(false, 0.01);
  EXPECT_EQ(skipped(poor, looks, why), 1u);
  EXPECT_EQ(skipped(forced, looks, why), 0u);
  EXPECT_EQ(skipped(poor, "pairs of edge and face", "beyond"), 0u);
  EXPECT_GT(skipped(forced, "pairs of edge and face", "beyond"), 0u);
  EXPECT_EQ(frobenius_norm(poor.of("interaction")[0]), 0.0);
  EXPECT_EQ(poor.model[0][0][0], without.model[0][0][0]);
  const SweepResult rich = solved({}, 1e4), all = solved(true, 1e4);
  EXPECT_EQ(skipped(rich, looks, why), 0u);
  EXPECT_EQ(std::memcmp(&rich.total[0], &all.total[0], sizeof(ScatteringMatrix)), 0);
}

// Strips that end at the foot of a cube on a block run on as images only where what edges send to other faces counts, too.
TEST(InteractionReach, WithoutItEdgesAreThoseWithoutInteraction) {
  const auto solved = [&](Use use, double budget) {
    SolveOptions o = adaptive(true, 2);
    o.edges.interaction = use;
    o.edges.interaction_budget = budget;
    return solve_soup(cube_on_block(6 * lambda, lambda, 2 * lambda), monostatic({{70 * degree, 25 * degree}}, frequency), o)
        .total[0];
  };
  EXPECT_EQ(solved({}, 0.01).s, solved(false, 0.01).s);
  EXPECT_GT(largest(solved({}, 1e6) - solved(false, 1e6)), 1e-3 * lambda);
}

TEST(PairPlan, AzimuthsOfFacesMissNothing) {
  std::mt19937 random(7);
  int met = 0;
  for (int body = 0; body < 60; ++body) {
    const Target target(build_mesh(plate_and_another(random), 1.0).mesh);
    const Look look = any_look(random);
    const LookVectors vectors = look_vectors(look);
    const PlaneWave wave{vectors.incident, vectors.electric, 0.0};
    const InteractionParts parts(target.mesh, target.wedges, {}, 1.0);
    const std::vector<double> wavenumbers{wavenumber(frequency)};
    const std::vector<bool> large(target.mesh.patches.size(), true);
    for (const EdgeAxis& axis : parts.axes) {
      const WedgeIncidence incidence = incidence_on(*axis.wedge, vectors.incident);
      const double weight = incidence_weight(*axis.wedge, incidence);
      if (weight == 0.0) continue;
      const LitEdgePiece piece{&axis, &wave, incidence.faces[0], 0.0, axis.length, weight};
      for (std::uint32_t patch = 0; patch < large.size(); ++patch) {
        if (patch == axis.wedge->faces[0].patch) continue;
        const std::vector<std::uint32_t> only{patch};
        const std::vector<AzimuthRange> range{azimuths_of(axis, target.mesh, patch, parts.patches[patch])};
        const ReceivingFaces faces{target.faces, large, parts.corners, only};
        const double tolerance = 1e-6 * lambda;
        const IlluminatedFaces all = illuminated_faces(faces, vectors, wavenumbers, piece, {0, tolerance});
        const double size = largest(all.scattering[0]);
        const bool seen = expected_of_pair(axis, target.mesh, patch, parts.patches[patch]) > 0.0;
        EXPECT_LT(size, seen ? 1e9 : 1e-12 * lambda);
        met += size > 0.0 ? 1 : 0;
        const IlluminatedFaces within = illuminated_faces(faces, vectors, wavenumbers, piece, {0, tolerance, range});
        ScatteringMatrix difference = all.scattering[0];
        difference += ScatteringMatrix(within.scattering[0]) *= -1.0;
        EXPECT_LT(largest(difference), 1e-4 * lambda) << "body " << body;  // rules of other panels, as large as their own limit
      }
    }
  }
  EXPECT_GT(met, 100);
}

std::uint64_t beyond_its_budget(const Contribution& interaction) {
  std::uint64_t sum = 0;
  for (const Count& each : interaction.counts) sum += each.why == beyond_budget ? each.count : 0;
  return sum;
}

// Candidates have prices known beforehand, right within a factor of ten (docs/theory/interaction.md): measured .7 to 14 times
// what is allowed, by two or three pairs, where boxes of two wavelengths see one another past many corners.
TEST(InteractionBudget, CountedWorkIsOfItsOrder) {
  const Target target(build_mesh(boxes(8, 2 * lambda), 1.0).mesh);
  const Sweep sweep = monostatic({{1.1, 0.4}, {1.5, 0.8}, {0.7, 2.5}}, frequency);
  for (const double budget : {16.0, 64.0, 256.0}) {  // 4 pays for one of 4 608 pairs, and so for none
    SolveOptions o = adaptive(true);
    o.edges.interaction_budget = budget;
    const SolvePlan plan(target, sweep, o);
    const LookSolver solver(plan);
    for (std::size_t look = 0; look < sweep.looks.size(); ++look) {
      Progress none({});
      const LookResult result = solver.solve(look, none, 1.0);
      const double allowed = interaction_work(plan);
      const Contribution& interaction = result.mechanisms[plan.index_of("interaction")];
      const double work = interaction.work;
      EXPECT_GT(allowed, 0.0);
      EXPECT_GT(work, 0.0);
      measured("work over what is allowed", work / allowed, "");
      EXPECT_LT(work, 20.0 * allowed) << "budget " << budget << ", look " << look;
      EXPECT_GT(beyond_its_budget(interaction), 0u);
      ASSERT_EQ(interaction.missing.size(), 1u);
      EXPECT_GT(interaction.missing[0], 0.0);
      EXPECT_TRUE(std::isfinite(interaction.missing[0]));
    }
  }
}

// The estimate is one for what many pairs add with phases of their own: root mean square over looks.
TEST(InteractionBudget, WhatIsLeftOutIsNoLargerThanItSays) {
  const Target target(build_mesh(two_boxes(2 * lambda, lambda), 1.0).mesh);
  std::vector<Direction> directions;
  for (int i = 0; i < 12; ++i) directions.push_back({1.0 + 0.07 * i, 0.2 + 0.5 * i});
  const Sweep sweep = monostatic(directions, frequency);
  const auto solved = [&](double budget) {
    SolveOptions o = adaptive(true);
    o.edges.interaction_budget = budget;
    const SolvePlan plan(target, sweep, o);
    const LookSolver solver(plan);
    std::vector<Contribution> results;
    for (std::size_t look = 0; look < directions.size(); ++look) {
      Progress none({});
      results.push_back(solver.solve(look, none, 1.0).mechanisms[plan.index_of("interaction")]);
    }
    return results;
  };
  const std::vector<Contribution> whole = solved(unlimited_interaction_budget);
  for (const double budget : {4.0, 16.0, 64.0}) {  // no pair, a few, most
    std::vector<Contribution> part = solved(budget);
    std::vector<double> missing, estimate;
    for (std::size_t look = 0; look < directions.size(); ++look) {
      EXPECT_EQ(beyond_its_budget(whole[look]), 0u);
      if (part[look].missing.empty()) continue;
      ScatteringMatrix difference = whole[look].at(0, 0);
      difference += part[look].at(0, 0) *= -1.0;
      missing.push_back(std::max(std::abs(difference.at(0, 0)), std::abs(difference.at(1, 1))));
      estimate.push_back(part[look].missing[0]);
    }
    ASSERT_GT(missing.size(), 6u);
    measured("left out, rms", rms(missing) / lambda, "wavelengths");
    measured("its estimate, rms", rms(estimate) / lambda, "wavelengths");
    EXPECT_LT(rms(missing), 1.5 * rms(estimate));   // a root mean square of a dozen is known to about a fifth
    EXPECT_GT(rms(missing), 0.02 * rms(estimate));  // and no estimate that says nothing
  }
}

TEST(InteractionBudget, AnActiveOneGivesTheSameBytesOnAnyThreads) {
  const Target target(build_mesh(boxes(8, 2 * lambda), 1.0).mesh);
  const Sweep sweep = monostatic({{1.1, 0.4}, {1.5, 0.8}, {0.7, 2.5}}, frequency);
  SolveOptions o = adaptive(true);
  o.edges.interaction_budget = EdgeOptions{}.interaction_budget;
  o.threads = 1;
  const SweepResult one = solve(target, sweep, o);
  EXPECT_GT(skipped(one, "pairs of edge and face", "beyond edges.between_budget"), 0u);
  o.threads = 2;
  const SweepResult two = solve(target, sweep, o);
  EXPECT_EQ(std::memcmp(one.total.data(), two.total.data(), one.total.size() * sizeof one.total[0]), 0);
  EXPECT_EQ(one.error, two.error);
}

TEST(InteractionBudget, NoneLeavesTheInteractionOut) {
  const Sweep sweep = monostatic({{1.2, 0.5}}, frequency);
  SolveOptions o = adaptive(true);
  o.edges.interaction_budget = 0.0;
  const SweepResult none = solve_soup(shapes::dihedral(3 * lambda, 3 * lambda), sweep, o);
  EXPECT_EQ(skipped(none, "looks without edge-face interaction", "edges.between_budget is 0"), 1u);
  const SweepResult without = solve_soup(shapes::dihedral(3 * lambda, 3 * lambda), sweep, adaptive(false));
  EXPECT_EQ(none.total[0].s, without.total[0].s);
  o.edges.interaction_budget = -1.0;
  EXPECT_THROW(solve_soup(shapes::dihedral(3 * lambda, 3 * lambda), sweep, o), InputError);
}

TEST(InteractionBudget, WhatIsTooSmallIsTold) {
  const Sweep sweep = monostatic({{1.2, 0.5}}, frequency);
  const SweepResult small = solve_soup(shapes::dihedral(0.9 * lambda, 0.9 * lambda), sweep, adaptive(true));
  EXPECT_EQ(skipped(small, "frequencies without edge-face interaction", "no edge"), 1u);
  EXPECT_EQ(skipped(small, "edges without edge-face interaction", "shorter"), 7u);  // six rims, and the back of the fold
  EXPECT_EQ(skipped(small, "faces without edge-face interaction", "smaller"), 2u);
}

TEST(InteractionBudget, MemoryDoesNotGrowWithThePairs) {
  EXPECT_EQ(bytes_of_pairs(1e9, 1e9), bytes_of_pairs(1e12, 1e9));
  EXPECT_LT(interaction_bytes(1) + bytes_of_pairs(1e12, 1e9), 20e6);
}

}  // namespace
}  // namespace raytube::testing::interaction
