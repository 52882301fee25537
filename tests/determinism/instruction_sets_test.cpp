// The same bytes under any instruction set, Embree's and our own.
#include <gtest/gtest.h>

#include <cstring>

#include "core/instruction_set.h"
#include "math/lanes.h"
#include "run.h"
#include "shapes.h"

namespace raytube {
namespace {

using namespace raytube::testing;

// Those this processor has; more than one wherever the program runs at all.
std::vector<std::string> instruction_sets() {
  std::vector<std::string> sets{"sse2", "sse4.2", "avx", "avx2"};
  if (widest_instruction_set() == InstructionSet::avx512) sets.push_back("avx512");
  return sets;
}

class AllInstructionSets : public ::testing::Test {
 protected:
  ~AllInstructionSets() override { limit_instruction_set(name_of(widest_instruction_set())); }

  // Rays spread over curved shadow boundaries and along edges: what single precision could mistake is in every one of these
  // looks.
  static void expect_same_bytes(const PolygonSoup& soup, TubeMode mode) {
    Sweep sweep{{9e9, 10e9}, {}, true};
    for (int i = 0; i < 7; ++i) sweep.looks.push_back({{0.3 + 0.2 * i, 0.7 * i}, {0.5 + 0.2 * i, 0.7 * i}});
    SolveOptions o = options(EdgeMethod::fringe);
    o.tubes.mode = mode;
    std::vector<ScatteringMatrix> first;
    for (const std::string& set : instruction_sets()) {
      limit_instruction_set(set);
      const SweepResult result = solve_soup(soup, sweep, o);
      if (first.empty()) first = result.total;
      EXPECT_EQ(std::memcmp(first.data(), result.total.data(), first.size() * sizeof first[0]), 0) << set;
    }
  }
};

TEST_F(AllInstructionSets, GiveTheSameBytesOfASphere) {
  expect_same_bytes(shapes::icosphere(4, 0.2), TubeMode::uniform);
  expect_same_bytes(shapes::icosphere(4, 0.2), TubeMode::adaptive);
}
TEST_F(AllInstructionSets, GiveTheSameBytesOfATrihedral) {
  expect_same_bytes(shapes::trihedral(0.4), TubeMode::uniform);
  expect_same_bytes(shapes::trihedral(0.4), TubeMode::adaptive);
}
TEST_F(AllInstructionSets, GiveTheSameBytesOfACylinder) {
  expect_same_bytes(shapes::cylinder(0.1, 0.3, 90), TubeMode::uniform);
  expect_same_bytes(shapes::cylinder(0.1, 0.3, 90), TubeMode::adaptive);
}

TEST_F(AllInstructionSets, GiveTheSameElementaryFunctions) {
  std::vector<double> first;
  for (const std::string& set : instruction_sets()) {
    limit_instruction_set(set);
    std::vector<double> all;
    for (int i = 0; i < 20000; ++i) {
      Reals x;
      for (std::size_t lane = 0; lane < lanes; ++lane) x[lane] = 1e-3 * i * i - 3e4 + 7e2 * static_cast<double>(lane);
      const Complexes phasors = unit_phasors(x);
      const Reals sinc = sincs(x), drop = one_minus_exp({{0.0, 1e-9 * i, 1e-3 * i, 1.0 * i, 0.1, 1.0, 2.0, 50.0}});
      for (std::size_t lane = 0; lane < lanes; ++lane)
        all.insert(all.end(), {phasors.re[lane], phasors.im[lane], sinc[lane], drop[lane]});
    }
    if (first.empty()) first = all;
    EXPECT_EQ(std::memcmp(first.data(), all.data(), all.size() * sizeof all[0]), 0) << set;
  }
}

}  // namespace
}  // namespace raytube
