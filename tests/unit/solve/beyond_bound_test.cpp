// Rows beyond their bound are named, whatever the method: looks that were kept are given back spoilt.
#include <gtest/gtest.h>

#include <limits>

#include "run.h"
#include "shapes.h"
#include "solve/look_result.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double wave = 3e9;

// The solve of a look across a face, in which the first bounce is `amplitude` [m].
std::vector<BeyondBound> beyond_bound(EdgeMethod method, double amplitude) {
  const Target target(build_mesh(shapes::cube(1.0), 1.0).mesh);
  const Sweep sweep = monostatic({{pi / 2, 0.0}}, wave);
  SolveOptions options;
  options.edges.method = method;
  std::string kept;
  options.kept.keep = [&](std::size_t, std::string bytes) { kept = std::move(bytes); };
  solve(target, sweep, options);
  LookResult look = *look_of_bytes(kept, 1, mechanism_list().size());
  look.tubes.bounces.front().front() = ScatteringMatrix{};
  look.tubes.bounces.front().front().at(0, 0) = amplitude;
  options.kept = {{}, [&](std::size_t) { return look_bytes(look); }, {}};
  return solve(target, sweep, options).statistics.beyond_bound;
}

// A cube of 1 m may have up to k A / 2 pi = 10 m there.
TEST(BeyondBound, AmplitudesAreComparedWithTheTarget) {
  EXPECT_TRUE(beyond_bound(EdgeMethod::fringe, 5.0).empty());
  const std::vector<BeyondBound> found = beyond_bound(EdgeMethod::fringe, 100.0);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].rows, 1u);
  EXPECT_GT(found[0].ratio, 1.0);
}

TEST(BeyondBound, RaysAreOnlyAskedForANumber) {
  EXPECT_TRUE(beyond_bound(EdgeMethod::utd, 1e6).empty());
  for (const double none : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(beyond_bound(EdgeMethod::utd, none).size(), 1u) << none;
}

}  // namespace
}  // namespace raytube
