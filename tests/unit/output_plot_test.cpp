// Which curves are drawn, and how.
#include <gmock/gmock.h>

#include <limits>

#include "output/plots/plot.h"
#include "output/tables/cuts.h"
#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

Sweep grid(const std::vector<double>& theta_deg, const std::vector<double>& phi_deg, const std::vector<double>& ghz) {
  Sweep sweep;
  for (const double f : ghz) sweep.frequencies.push_back(f * 1e9);
  for (const double t : theta_deg)
    for (const double p : phi_deg) sweep.looks.push_back({{t * degree, p * degree}, {t * degree, p * degree}});
  return sweep;
}

SweepResult constant(const Sweep& sweep, double co, double cross) {
  SweepResult result;
  result.total.assign(sweep.rows(), {{{{Complex(co), Complex(cross)}, {Complex(cross), Complex(co)}}}});
  return result;
}

Cuts cuts_of(const Sweep& sweep, std::size_t most = 4) { return choose_cuts(sweep, constant(sweep, 1.0, 0.0), most); }

TEST(Cuts, TheSweptQuantityIsTheAxis) {
  EXPECT_EQ(cuts_of(grid({90}, {0, 1, 2}, {10})).axis, "azimuth φ (degrees)");
  EXPECT_EQ(cuts_of(grid({0, 1, 2}, {45}, {10})).axis, "polar angle θ (degrees)");
  EXPECT_EQ(cuts_of(grid({90}, {0}, {8, 9, 10})).axis, "frequency (GHz)");
  EXPECT_EQ(cuts_of(grid({90}, {0, 1, 2}, {10})).cuts.front().fixed, "10 GHz, θ = 90°");
}

TEST(Cuts, OthersHeldFixedGiveSeveralCuts) {
  const Cuts cuts = cuts_of(grid({80, 90}, {0, 1, 2}, {10}));
  ASSERT_EQ(cuts.cuts.size(), 2u);
  EXPECT_EQ(cuts.cuts[1].fixed, "10 GHz, θ = 90°");
  EXPECT_THAT(cuts.cuts[1].x, ElementsAre(0, 1, 2));
}

TEST(Cuts, TooManyAreSampledFromFirstToLast) {
  const Cuts cuts = cuts_of(grid({10, 20, 30, 40, 50, 60, 70}, {0, 1, 2, 3, 4, 5, 6, 7}, {10}), 3);
  EXPECT_EQ(cuts.total, 7u);
  ASSERT_EQ(cuts.cuts.size(), 3u);
  EXPECT_EQ(cuts.cuts.front().fixed, "10 GHz, θ = 10°");
  EXPECT_EQ(cuts.cuts.back().fixed, "10 GHz, θ = 70°");
}

TEST(Cuts, UnorderedListsAreDrawnByNumber) {
  Sweep sweep{{1e9}, {}, false};
  for (int i = 0; i < 5; ++i) sweep.looks.push_back({{0.1 * i, 0.2 * i}, {0.1 * i, 0.2 * i}});
  const Cuts cuts = cuts_of(sweep);
  EXPECT_EQ(cuts.axis, "look number");
  ASSERT_EQ(cuts.cuts.size(), 1u);
  EXPECT_THAT(cuts.cuts[0].x, ElementsAre(0, 1, 2, 3, 4));
}

TEST(Cuts, ReceiverAngleCountsWhenBistatic) {
  Sweep sweep{{1e9}, {}, true};
  for (int i = 0; i < 3; ++i) sweep.looks.push_back({{90 * degree, 0}, {90 * degree, i * degree}});
  EXPECT_EQ(cuts_of(sweep).axis, "receiver azimuth φ (degrees)");
  EXPECT_EQ(cuts_of(sweep).cuts.front().fixed, "1 GHz, θ = 90°, φ = 0°, receiver θ = 90°");
}

std::string script(double co, double cross, const std::string& title = "t") {
  const Sweep sweep = grid({90}, {0, 1, 2}, {10});
  return rcs_plot_script("svg", "x.svg", title, sweep, constant(sweep, co, cross));
}

TEST(Plot, LabelsCarryUnits) {
  EXPECT_THAT(script(1.0, 0.5), HasSubstr("set ylabel 'σ (dBsm)'"));
  EXPECT_THAT(script(1.0, 0.5), HasSubstr("set xlabel 'azimuth φ (degrees)'"));
  for (const char* channel : {"title 'VV'", "title 'VH'", "title 'HV'", "title 'HH'"})
    EXPECT_THAT(script(1.0, 0.5), HasSubstr(channel));
}

TEST(Plot, RoundingDustDoesNotStretchTheAxis) {
  EXPECT_THAT(script(1.0, 1e-17), HasSubstr("set yrange [10:15]"));
  EXPECT_THAT(script(1.0, 1e-17), HasSubstr("title 'VH < -69 dBsm'"));
  EXPECT_THAT(script(1.0, 0.0), Not(HasSubstr("inf")));
  EXPECT_THAT(script(0.0, 0.0), HasSubstr("set yrange [-100:0]"));
}

TEST(Plot, TitleIsTakenLiterally) { EXPECT_THAT(script(1.0, 1.0, "it's\n`ls`"), HasSubstr("title 'it''s `ls`'")); }

// A rod of 1 m seen across: at 10 GHz its lobes ask for 0.43 degrees.
TEST(Plot, StepsTooWideForTheLobesAreNotJoined) {
  const std::vector<dvec3> rod{{0.0, -0.5, 0.0}, {0.0, 0.5, 0.0}};
  const auto drawn = [&](double step, const std::vector<double>& theta) {
    const Sweep sweep = grid(theta, {0, step, 2 * step}, {10});
    return rcs_plot_script("svg", "x.svg", "t", sweep, constant(sweep, 1.0, 1e-9), rod);
  };
  EXPECT_THAT(drawn(0.42, {90}), AllOf(HasSubstr("using 1:2 with linespoints"), Not(HasSubstr("not joined"))));
  EXPECT_THAT(drawn(0.44, {90}),
              AllOf(HasSubstr("using 1:2 with points"), HasSubstr("keyentry with points"), Not(HasSubstr("with lines")),
                    HasSubstr("set title '10 GHz, θ = 90°; points not joined: steps too wide for the lobes'")));
  // Near the pole phi turns the direction less: one panel is joined, the other is not.
  EXPECT_THAT(drawn(0.44, {30, 90}),
              AllOf(HasSubstr("$cut0 using 1:2 with linespoints"), HasSubstr("$cut1 using 1:2 with points")));
}

// A stand-in for gnuplot that is content and draws nothing.
TEST(Plot, AMissingPictureIsNoticed) {
  const Scratch scratch;
  std::filesystem::permissions(scratch.write("gnuplot", "#!/bin/sh\nexit 0\n"), std::filesystem::perms::owner_all);
  const std::string path = getenv("PATH");
  setenv("PATH", (scratch.folder().string() + ":" + path).c_str(), 1);
  const Sweep sweep = grid({90}, {0, 1, 2}, {10});
  EXPECT_THAT(plot_rcs(scratch.folder(), "t", sweep, constant(sweep, 1.0, 0.5)), HasSubstr("gnuplot left no picture"));
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch.folder()), {}), 1);
}

TEST(Plot, WritesBothPicturesOrSaysWhyNot) {
  const Scratch scratch;
  const Sweep sweep = grid({90}, {0, 1, 2}, {10});
  const std::string trouble = plot_rcs(scratch.folder(), "t", sweep, constant(sweep, 1.0, 0.5));
  if (!trouble.empty()) {
    EXPECT_THAT(trouble, HasSubstr("rcs.csv holds the same curves"));
    GTEST_SKIP() << trouble;
  }
  EXPECT_EQ(text_of(scratch / "rcs.png").substr(1, 3), "PNG");
  EXPECT_THAT(text_of(scratch / "rcs.svg"), HasSubstr("<svg"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch.folder()), {}), 2);
}

}  // namespace
}  // namespace raytube
