// Which curves are drawn, and how.
#include <gmock/gmock.h>

#include <limits>

#include "output/plots/parts_plot.h"
#include "output/plots/plot.h"
#include "output/plots/polar_plot.h"
#include "output/tables/cuts.h"
#include "output/tables/sliding_sector.h"
#include "output/tables/sweep_map.h"
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

// As above, but with the peak in a cut that is not among the evenly spread ones.
TEST(Cuts, ThatThroughThePeakIsAmongTheChosen) {
  const Sweep sweep = grid({10, 20, 30, 40, 50, 60, 70}, {0, 1, 2, 3, 4, 5, 6, 7}, {10});
  SweepResult result = constant(sweep, 1.0, 0.0);
  result.total[4 * 8 + 3].at(1, 1) = 2.0;
  const Cuts cuts = choose_cuts(sweep, result, 3);
  ASSERT_EQ(cuts.cuts.size(), 3u);
  EXPECT_EQ(cuts.cuts[0].fixed, "10 GHz, θ = 10°");
  EXPECT_EQ(cuts.cuts[1].fixed, "10 GHz, θ = 50°");
  EXPECT_EQ(cuts.cuts[2].fixed, "10 GHz, θ = 70°");
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
  EXPECT_THAT(drawn(0.44, {90}), Not(HasSubstr("$sectors")));  // three rows have no sector
  // Near the pole phi turns the direction less: one panel is joined, the other is not.
  EXPECT_THAT(drawn(0.44, {30, 90}),
              AllOf(HasSubstr("$cut0 using 1:2 with linespoints"), HasSubstr("$cut1 using 1:2 with points")));
}

TEST(Plot, GridsAreMapsWithTheCutsThroughThePeak) {
  const Sweep sweep = grid({10, 20, 30, 40, 50, 60}, {0, 1, 2, 3, 4, 5, 6, 7}, {10});
  SweepResult result = constant(sweep, 1.0, 1e-9);
  result.total[4 * 8 + 3].at(1, 1) = 10.0;  // 20 dB above the rest: 10 lg 4 pi + 20 = 31.0 dBsm
  const std::string text = rcs_plot_script("svg", "x.svg", "t", sweep, result);
  EXPECT_THAT(text, AllOf(HasSubstr("$map0"), HasSubstr("$map3"), Not(HasSubstr("$map1"))));
  EXPECT_THAT(text, HasSubstr("peak 31.0 dBsm, HH, at 10 GHz, θ = 50°, φ = 3°"));
  EXPECT_THAT(text, HasSubstr("set title 'through the peak: 10 GHz, θ = 50°'"));
  EXPECT_THAT(text, HasSubstr("set title 'through the peak: 10 GHz, φ = 3°'"));
  EXPECT_THAT(text, AllOf(HasSubstr("\n50 10.9921 "), HasSubstr(" 30.9921\n")));
  EXPECT_THAT(text, HasSubstr("set cbrange [10:31]\nset cblabel 'σ (dBsm)'"));
  result.total[0].at(0, 1) = 1.1;  // 19.2 dB below the peak
  EXPECT_THAT(rcs_plot_script("svg", "x.svg", "t", sweep, result), AllOf(HasSubstr("$map1"), HasSubstr("$map2")));
}

TEST(Plot, AMapDiffersInTwoQuantitiesOnly) {
  const Sweep sweep = grid({10, 20, 30, 40, 50}, {0, 1, 2, 3, 4, 5}, {10, 11});
  const RowCoordinates coordinates = coordinates_of_rows(sweep);
  const auto map = map_through(7, coordinates, plan_cuts(coordinates), 4);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->across, RowCoordinates::phi);
  EXPECT_EQ(map->up, RowCoordinates::theta);
  EXPECT_EQ(map->fixed, "11 GHz");
  EXPECT_EQ(map->rows[5 + 6 * 4], sweep.row(5 + 6 * 4, 1));
  EXPECT_FALSE(map_through(7, coordinates, plan_cuts(coordinates), 12));  // few enough for panels
}

std::optional<SweepMap> map_of(const Sweep& sweep) {
  const RowCoordinates coordinates = coordinates_of_rows(sweep);
  return map_through(0, coordinates, plan_cuts(coordinates), 4);
}

TEST(Plot, AMapMayHaveHolesAndRepeatedRows) {
  Sweep sweep = grid({10, 20, 30, 40, 50}, {0, 1, 2, 3, 4, 5}, {10});
  sweep.looks.pop_back();
  sweep.looks.push_back(sweep.looks.front());
  const auto map = map_of(sweep);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->rows.front(), 0u);
  EXPECT_EQ(map->rows.back(), SweepMap::hole);
  EXPECT_EQ(map->held, 30u);
  EXPECT_THAT(rcs_plot_script("svg", "x.svg", "t", sweep, constant(sweep, 1.0, 0.0)), HasSubstr(" NaN \n"));
  Sweep diagonal{{1e9}, {}, false};  // what fills a fifth of a grid has none
  for (const double t : {10, 20, 30, 40, 50}) diagonal.looks.push_back({{t * degree, t * degree}, {t * degree, t * degree}});
  EXPECT_FALSE(map_of(diagonal));
}

// As of looks that are alike in solid angle.
TEST(Plot, AMapMayHaveFewerAzimuthsTowardsThePole) {
  Sweep sweep{{1e9}, {}, false};
  std::vector<std::size_t> first;
  for (const int theta : {0, 10, 30, 50, 70, 90}) {
    first.push_back(sweep.looks.size());
    const int count = theta == 0 ? 1 : 2 + theta / 10 * 4;
    for (int i = 0; i < count; ++i) {
      const Direction d{theta * degree, i * 360.0 / count * degree};
      sweep.looks.push_back({d, d});
    }
  }
  const auto map = map_of(sweep);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->x.size(), 38u);
  EXPECT_EQ(map->rows[37], 0u);             // the pole is the nearest of its row everywhere
  EXPECT_EQ(map->rows[38 + 37], first[1]);  // 0 is nearer to 351 degrees than 300 is
  EXPECT_EQ(map->rows[5 * 38 + 37], first[5] + 37);
}

// As an arc tangent gives them.
TEST(Plot, AMapIsNotTornByRounding) {
  Sweep sweep = grid({10, 20, 30, 40, 50}, {0, 1, 2, 3, 4, 5}, {10});
  for (std::size_t i = 0; i < sweep.looks.size(); ++i) {
    Direction& d = sweep.looks[i].transmit;
    d.theta += 1e-14 * static_cast<double>(i % 3), d.phi -= 1e-14 * static_cast<double>(i % 5);
    sweep.looks[i].receive = d;
  }
  EXPECT_TRUE(map_of(sweep));
  sweep.bistatic = true;  // with receivers that are the transmitters
  EXPECT_TRUE(map_of(sweep));
}

// Levels that rise by 1 dB a step: of the 11 rows about the i-th the second, the sixth and the tenth are i - 4, i and i + 4.
TEST(SlidingSectors, OfALineAreParallelLines) {
  Cut cut{"", {}, {}, {}, RowCoordinates::theta};
  for (int i = 0; i < 40; ++i) {
    cut.x.push_back(0.5 * i);
    for (auto& channel : cut.sigma_dbsm) channel.push_back(i);
  }
  const auto sectors = sliding_sectors(cut);
  ASSERT_TRUE(sectors);
  EXPECT_DOUBLE_EQ(sectors->width, 5.0);
  ASSERT_EQ(sectors->x.size(), 30u);  // five rows at either end have no whole sector
  for (std::size_t i = 0; i < 30; ++i) {
    EXPECT_EQ(sectors->x[i], cut.x[i + 5]);
    EXPECT_EQ(sectors->levels[3][i].low, cut.sigma_dbsm[3][i + 5] - 4.0);
    EXPECT_EQ(sectors->levels[3][i].median, cut.sigma_dbsm[3][i + 5]);
    EXPECT_EQ(sectors->levels[3][i].high, cut.sigma_dbsm[3][i + 5] + 4.0);
  }
  cut.quantity = RowCoordinates::look_number;
  EXPECT_FALSE(sliding_sectors(cut));
}

// One strong row in a circle: with it at either end the sectors about the other end have it, too, whether or not the first
// azimuth is there twice.
TEST(SlidingSectors, GoOnOverTheEndsOfACircle) {
  for (const int rows : {360, 361}) {
    Cut cut{"", {}, {}, {}, RowCoordinates::phi};
    for (int i = 0; i < rows; ++i) {
      cut.x.push_back(i);
      for (auto& channel : cut.sigma_dbsm) channel.push_back(i % 360 < 2 ? 0.0 : -50.0);
    }
    const auto sectors = sliding_sectors(cut);
    ASSERT_TRUE(sectors);
    EXPECT_EQ(sectors->width, 10.0);
    ASSERT_EQ(sectors->x.size(), cut.x.size());
    EXPECT_EQ(sectors->levels[0][356].high, 0.0);    // 351 ... 361: two of eleven
    EXPECT_EQ(sectors->levels[0][355].high, -50.0);  // 350 ... 360: one of them
    EXPECT_EQ(sectors->levels[0][5].high, 0.0);      // 0 ... 10: two
    EXPECT_EQ(sectors->levels[0][6].high, -50.0);
  }
}

TEST(SlidingSectors, AreDrawnWhereStepsAreTooWide) {
  const std::vector<dvec3> rod{{0.0, -0.5, 0.0}, {0.0, 0.5, 0.0}};
  std::vector<double> phi;
  for (int i = 0; i <= 40; ++i) phi.push_back(0.5 * i);
  const Sweep sweep = grid({90}, phi, {10});
  const std::string text = rcs_plot_script("svg", "x.svg", "t", sweep, constant(sweep, 1.0, 1e-9), rod);
  EXPECT_THAT(text, AllOf(HasSubstr("set key title 'sectors of 5°'"), HasSubstr("title 'VV 10–90 %'"),
                          HasSubstr("title 'HH median'"), HasSubstr("$cut0 using 1:2 with points"), Not(HasSubstr("VH median"))));
}

TEST(PolarPlot, IsOfCirclesWithoutWideGaps) {
  const auto circle = [](double from, double step, int count) {
    std::vector<double> degrees;
    for (int i = 0; i < count; ++i) degrees.push_back(from + step * i);
    return degrees;
  };
  EXPECT_TRUE(goes_round(circle(0, 5, 72)));
  EXPECT_TRUE(goes_round(circle(-180, 1, 361)));
  EXPECT_TRUE(goes_round(circle(-175, 1, 351)));
  EXPECT_FALSE(goes_round(circle(0, 1, 350)));  // 349 ... 360
  EXPECT_FALSE(goes_round(circle(0, 15, 25)));
  EXPECT_TRUE(has_full_circle(grid({90}, circle(0, 5, 72), {10})));
  EXPECT_FALSE(has_full_circle(grid(circle(0, 1, 181), {0}, {10})));
}

// sigma = 4 pi |S|^2 of S = 1 m is 10.99 dBsm: over a middle of 0 dBsm, a ring below the next ten.
TEST(PolarPlot, HoldsTheCutThroughThePeak) {
  std::vector<double> phi;
  for (int i = 0; i < 36; ++i) phi.push_back(10.0 * i);
  const Sweep sweep = grid({30, 60, 90}, phi, {10});
  SweepResult result = constant(sweep, 1.0, 1e-9);
  result.total[36 + 9].at(0, 0) = 2.0;  // 6.02 dB more, at theta 60, phi 90
  const auto text = polar_plot_script("svg", "x.svg", "t", sweep, result, {});
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, AllOf(HasSubstr("10 GHz, θ = 60°; σ (dBsm) over azimuth φ (degrees)"),
                           HasSubstr("\n80 10.9921\n90 17.0127\n"), HasSubstr("set label '10' at 10,0 "),
                           HasSubstr("set label '20' at 20,0 "), HasSubstr("\n350 10.9921\n0 10.9921\nEOD")));
  EXPECT_FALSE(
      polar_plot_script("svg", "x.svg", "t", grid({90}, {0, 1, 2}, {10}), constant(grid({90}, {0, 1, 2}, {10}), 1.0, 0.0), {}));
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

TEST(Plot, AFullCircleHasAPolarPlotBeside) {
  const Scratch scratch;
  std::vector<double> phi;
  for (int i = 0; i < 72; ++i) phi.push_back(5.0 * i);
  const Sweep sweep = grid({10, 20, 30, 40, 50}, phi, {10});
  const std::string trouble = plot_rcs(scratch.folder(), "t", sweep, constant(sweep, 1.0, 0.5));
  if (!trouble.empty()) GTEST_SKIP() << trouble;
  EXPECT_EQ(text_of(scratch / "rcs_polar.png").substr(1, 3), "PNG");
  EXPECT_THAT(text_of(scratch / "rcs_polar.svg"), HasSubstr("<svg"));
  EXPECT_THAT(text_of(scratch / "rcs.svg"), HasSubstr("<image"));  // the map
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch.folder()), {}), 4);
}

/// Two bounces, and edges 200 dB below; no waves.
SweepResult by_mechanism(const Sweep& sweep) {
  SweepResult result = constant(sweep, 2.0, 0.0);
  const SweepResult one = constant(sweep, 1.0, 0.0), faint = constant(sweep, 1e-10, 0.0), nothing = constant(sweep, 0.0, 0.0);
  result.bounces = {one.total, one.total};
  for (const Part part : all_parts) result.parts[part] = part == Part::edges_first ? faint.total : nothing.total;
  return result;
}

TEST(PartsPlot, ShowsWhatAddsAnythingOfTheCutThroughThePeak) {
  const Sweep sweep = grid({80, 90}, {0, 1, 2}, {10});
  SweepResult result = by_mechanism(sweep);
  result.total[4].at(1, 1) = 3.0;
  const std::string script = parts_plot_script("svg", "x.svg", "it's", sweep, result, {});
  EXPECT_THAT(script, AllOf(HasSubstr("(cut through the peak)"), HasSubstr("set title 'VV; 10 GHz, θ = 90°'"),
                            HasSubstr("set title 'HH; "), HasSubstr("title 'all together'"), HasSubstr("title 'bounce 2'"),
                            HasSubstr("keyentry with lines lc rgb '#2e8b3d' lw 2 dt (8,5) title 'edges, order 1 < "),
                            Not(HasSubstr("waves"))));
}

TEST(PartsPlot, RowsTooFarApartAreNotJoined) {
  const std::vector<dvec3> metre_wide = {{-0.5, 0, 0}, {0.5, 0, 0}};
  const Sweep few = grid({90}, {0, 30, 60}, {10});
  EXPECT_THAT(parts_plot_script("svg", "x.svg", "t", few, by_mechanism(few), metre_wide),
              AllOf(HasSubstr("$cut1 using 1:2 with points"), Not(HasSubstr("1:2 with lines "))));
  std::vector<double> degrees;
  for (int i = 0; i < 360; ++i) degrees.push_back(i);
  const Sweep many = grid({90}, degrees, {10});
  EXPECT_THAT(parts_plot_script("svg", "x.svg", "t", many, by_mechanism(many), metre_wide),
              AllOf(HasSubstr("set key title 'median of sectors of 10°'"), HasSubstr("$sectors1 using 1:3 with lines")));
}

}  // namespace
}  // namespace raytube
