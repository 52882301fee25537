// A program that calls the library with default options gets what the program's defaults give.
#include <gtest/gtest.h>

#include "case/read_case.h"
#include "case/target.h"
#include "run.h"

namespace raytube {
namespace {

using namespace raytube::testing;

// Every fifth look of the cylinder case, whose facets stand for a curved surface: a coarse grid alone would miss it.
TEST(LibraryDefaults, AreThoseOfTheProgram) {
  const Case c = read_case(RAYTUBE_SOURCE_DIR "/cases/cylinder/case.toml");
  Sweep sweep = c.sweep;
  sweep.looks.clear();
  for (std::size_t i = 0; i < c.sweep.looks.size(); i += 5) sweep.looks.push_back(c.sweep.looks[i]);
  const Target target(load_target(c).mesh);
  SolveOptions defaults;
  defaults.edges.method = c.edges.method;  // the case is about tubes alone
  const SweepResult library = solve(target, sweep, defaults), program = solve(target, sweep, {c.tubes, c.edges});
  EXPECT_GT(frobenius_norm(library.total[0]), 0.0);
  for (std::size_t row = 0; row < sweep.rows(); ++row)
    EXPECT_EQ(frobenius_norm(library.total[row] - program.total[row]), 0.0) << "row " << row;
}

// Faces too many and too small to be followed one by one are sampled: refinement begins at 10 tubes per wavelength, and ends
// above.
TEST(LibraryDefaults, RefineWhereTheFirstGridIsTooCoarse) {
  const TubeOptions tubes;
  EXPECT_TRUE(tubes.refines());
  EXPECT_LT(tubes.per_wavelength, tubes.max_per_wavelength);
}

}  // namespace
}  // namespace raytube
