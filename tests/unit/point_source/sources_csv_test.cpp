// The table and the points that `raytube sources` writes, and what its pictures are made of.
#include "point_source/sources_csv.h"

#include <gmock/gmock.h>

#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::EndsWith;
using ::testing::HasSubstr;

SourceStudy small_study() {
  SourceStudy study;
  study.title = "t";
  study.part_names = {"wall", "screen"};
  study.counted = 1;
  SourceRun run;
  run.point = {1.5, 0, -2};
  run.model = LaunchModel::plane_wave;
  run.rays_asked = 2000;
  run.rays = 1980;
  run.escaped = 990;
  run.absorbed = 900;
  run.cut = 90;
  run.seconds = 0.25;
  run.parts.resize(2);
  run.parts[1].first_hits = 99;
  run.parts[1].all_hits = 198;
  run.parts[1].limit = 0.0525;
  study.runs = {run};
  study.views = {{LaunchModel::plane_wave, 1980, 1980, {{0, 0, 0}}, {{{1, 2, 3}, 0}, {{4, 5, 6.5}, 7}}}};
  return study;
}

TEST(SourcesCsv, RowsHoldCountsSharesAndEmptyCellsForWhatIsNotKnown) {
  const Scratch scratch;
  write_sources_csv(scratch / "s.csv", small_study());
  const std::string text = text_of(scratch / "s.csv");
  EXPECT_THAT(text, HasSubstr("\nposition,x_m,y_m,z_m,model,rays_asked,rays,part,first_hits,all_hits,direct_percent,"));
  EXPECT_THAT(text, HasSubstr("\n0,1.5,0,-2,plane-wave,2000,1980,wall,0,0,0,0,,,,,,,990,900,90,0.25\n"));
  EXPECT_THAT(text, EndsWith("\n0,1.5,0,-2,plane-wave,2000,1980,screen,99,198,5,10,5.25,,,,,,990,900,90,0.25\n"));
}

TEST(SourcesPly, HoldsEveryHitWithModelAndBounce) {
  const Scratch scratch;
  write_hits_ply(scratch / "h.ply", small_study());
  const std::string text = text_of(scratch / "h.ply");
  EXPECT_THAT(text, HasSubstr("hits on screen"));
  EXPECT_THAT(text, HasSubstr("\nelement vertex 2\n"));
  EXPECT_THAT(text, EndsWith("\nend_header\n1 2 3 4 0\n4 5 6.5 4 7\n"));
}

}  // namespace
}  // namespace raytube
