// Pictures on request: which kind, which curves, in which unit; and the projection of the sphere.
#include <gmock/gmock.h>

#include <cmath>

#include "core/error.h"
#include "output/charts/chart.h"
#include "output/charts/curve_chart.h"
#include "output/charts/look_table.h"
#include "output/charts/sphere_map.h"
#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

TEST(Hammer, ThereAndBack) {
  for (const double theta : {1.0, 35.0, 90.0, 140.0, 179.0})
    for (const double phi : {-179.0, -90.0, 0.0, 10.0, 170.0}) {
      const auto direction = from_hammer(hammer(theta, phi));
      ASSERT_TRUE(direction);
      EXPECT_NEAR(direction->x, theta, 1e-9);
      EXPECT_NEAR(direction->y, phi, 1e-9);
    }
  EXPECT_FALSE(from_hammer({2.7, 0.9}));
  EXPECT_NEAR(hammer(90.0, 180.0).x, 2.0 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(hammer(0.0, 0.0).y, std::sqrt(2.0), 1e-12);
}

// The area of a small patch on the picture is its solid angle; differences are of second order in its size.
TEST(Hammer, AreasAreSolidAngles) {
  constexpr double d = 0.01;
  for (const double theta : {5.0, 60.0, 90.0, 130.0})
    for (const double phi : {-150.0, 0.0, 80.0}) {
      const dvec2 down = hammer(theta + d, phi) - hammer(theta - d, phi), right = hammer(theta, phi + d) - hammer(theta, phi - d);
      const double area = std::abs(down.x * right.y - down.y * right.x);
      const double solid_angle = 4.0 * d * d * degree * degree * std::sin(theta * degree);
      EXPECT_NEAR(area / solid_angle, 1.0, 1e-5) << theta << ' ' << phi;
    }
}

struct Sweep2d {
  std::vector<double> theta = {90.0}, phi = {0.0}, ghz = {10.0};
};

std::vector<double> steps_of(double first, double last, double step) {
  std::vector<double> values;
  for (double value = first; value <= last + 1e-9; value += step) values.push_back(value);
  return values;
}

// HH is 3 dB below VV, VH 40 dB; the peak is 10 dBsm at the middle of the table.
ResultTable table_of(const std::string& file, const Sweep2d& sweep) {
  ResultTable table;
  table.file = file;
  table.has_key = {true, true, true, false, false};
  table.has_channel = {true, true, false, true};
  for (const double t : sweep.theta)
    for (const double p : sweep.phi)
      for (const double f : sweep.ghz) table.rows.push_back({{f * 1e9, t, p, t, p}, {}, {0.0, -40.0, 0.0, -3.0}});
  table.rows[table.rows.size() / 2].sigma_dbsm[0] = 10.0;
  return table;
}

std::string drawn(const std::vector<ResultTable>& tables, const ChartOptions& options = {}, const std::string& file = "x.png") {
  return chart_script(made_chart(chart_results(tables), options), file);
}

const Sweep2d cut{.phi = steps_of(0, 359, 1)};
const Sweep2d window{.theta = steps_of(60, 120, 5), .phi = steps_of(-45, 45, 5)};
const Sweep2d whole{.theta = steps_of(0, 180, 10), .phi = steps_of(0, 350, 10)};

TEST(Chart, TheKindFollowsTheSweep) {
  EXPECT_THAT(drawn({table_of("a.csv", cut)}), AllOf(HasSubstr("$curves0"), Not(HasSubstr("with image"))));
  const std::string map = drawn({table_of("a.csv", window)});
  EXPECT_THAT(map, AllOf(HasSubstr("with image"), HasSubstr("set yrange [122.5:57.5]"), Not(HasSubstr("$graticule"))));
  EXPECT_THAT(map, AllOf(HasSubstr("$map0"), HasSubstr("$map3"), Not(HasSubstr("$map1"))));  // VH lies 50 dB below
  EXPECT_THAT(drawn({table_of("a.csv", whole)}), AllOf(HasSubstr("$graticule"), HasSubstr("set label 'θ = 30°'")));
  EXPECT_THAT(drawn({table_of("a.csv", {.phi = steps_of(0, 90, 5), .ghz = steps_of(8, 12, 0.5)})}),
              AllOf(HasSubstr("set ylabel 'frequency (GHz)'"), HasSubstr("set yrange [7.75:12.25]")));
  EXPECT_THAT(drawn({table_of("a.csv", whole)}, {.kind = ChartKind::curves}), HasSubstr("4 of 19 cuts"));
  EXPECT_THAT(drawn({table_of("a.csv", cut)}, {.kind = ChartKind::polar}), AllOf(HasSubstr("set polar"), HasSubstr("$disc0")));
}

TEST(Chart, ThetaAcrossIsTurned) {  // three azimuths of many polar angles: the plan's axis is theta
  const Sweep2d few{.theta = steps_of(0, 90, 1), .phi = steps_of(0, 50, 10)};
  EXPECT_THAT(drawn({table_of("a.csv", few)}), AllOf(HasSubstr("set xlabel 'azimuth φ (degrees)'"), HasSubstr("with image")));
}

TEST(Chart, SeveralResultsAreCurvesUnderTheirNames) {
  const std::string text = drawn({table_of("cube/out/rcs.csv", cut), table_of("plate/out/rcs.csv", cut)});
  EXPECT_THAT(text, AllOf(HasSubstr("title 'cube VV'"), HasSubstr("title 'plate HH'"), Not(HasSubstr("VH"))));
  EXPECT_THAT(text, HasSubstr("set multiplot layout 1,1 title 'cube, plate'"));
  const auto results = chart_results({table_of("a.csv", cut), table_of("b/a.csv", cut), table_of("a.csv", cut)});
  EXPECT_EQ(results[1].name, "b (2)");
  Sweep2d lower = cut;
  lower.ghz = {9.0};
  EXPECT_THAT(drawn({table_of("a.csv", cut), table_of("b.csv", lower)}), HasSubstr("title 'b, 9 GHz, θ = 90° VV'"));
}

TEST(Chart, CutsThatAllResultsHaveAreDrawn) {
  const Sweep2d two{.theta = {80, 90}, .phi = steps_of(0, 90, 1)}, other{.theta = {90, 100}, .phi = steps_of(0, 90, 1)};
  const auto panels = cut_panels(chart_results({table_of("a.csv", two), table_of("b.csv", other)}), 4);
  ASSERT_EQ(panels.size(), 1u);
  EXPECT_EQ(panels[0].title, "10 GHz, θ = 90°");
}

TEST(Chart, UnitsAndRanges) {
  const std::vector<ResultTable> one = {table_of("a.csv", cut)};
  EXPECT_THAT(drawn(one), AllOf(HasSubstr("set ylabel 'σ (dBsm)'\nset yrange [-40:15]"), HasSubstr("\n180 10 -40 -3\n")));
  EXPECT_THAT(drawn(one, {.unit = ChartUnit::square_metres}),
              AllOf(HasSubstr("set yrange [0:12]"), HasSubstr("\n180 10 0.0001 ")));
  EXPECT_THAT(drawn(one, {.range_db = 25.0, .unit = ChartUnit::db_of_peak}),
              AllOf(HasSubstr("set yrange [-25:5]"), HasSubstr("\n180 0 -45 -13\n")));
  EXPECT_THAT(drawn({table_of("a.csv", window)}, {.range_db = 20.0}), HasSubstr("set cbrange [-10:10]"));
  EXPECT_THAT(drawn(one, {.kind = ChartKind::polar, .range_db = 30.0}), HasSubstr("set rrange [0:30]"));
}

// Azimuths that end a step before they began: the curve of the disc closes.
TEST(Chart, PolarCurvesClose) {
  const std::string text = drawn({table_of("a.csv", cut)}, {.kind = ChartKind::polar, .channels = {0}});
  EXPECT_THAT(text, HasSubstr("\n359 10\n0 10\nEOD"));
}

TEST(Chart, SizeTerminalAndStyle) {
  const std::vector<ResultTable> one = {table_of("a.csv", cut)};
  EXPECT_THAT(drawn(one), HasSubstr("set terminal pngcairo fontscale 1 linewidth 1 pointscale 1 size 1100,640 "));
  EXPECT_THAT(drawn(one, {.size = {{2200, 1280}}}), HasSubstr("fontscale 2 linewidth 2 pointscale 2 size 2200,1280 "));
  EXPECT_THAT(drawn(one, {}, "x.pdf"),
              HasSubstr("set terminal pdfcairo fontscale 1 linewidth 1 pointscale 1 size 11.0000in,6.4000in "));
  EXPECT_THAT(drawn(one, {}, "x.svg"), HasSubstr("set terminal svg fontscale 1 linewidth 1 size 1100,640 "));
  EXPECT_THAT(drawn(one, {.print = true}), AllOf(HasSubstr("lc rgb '#000000'"), Not(HasSubstr("#1f5fbf"))));
  EXPECT_THAT(drawn(one, {.title = "it's\n`ls`"}), HasSubstr("title 'it''s `ls`'"));
}

TEST(Chart, HolesOfAMapAreLeftOut) {
  ResultTable table = table_of("a.csv", window);
  table.rows.erase(table.rows.begin());
  EXPECT_THAT(drawn({table}), HasSubstr("NaN "));
}

TEST(Chart, WhatDoesNotFitIsRefused) {
  const auto refused = [](const std::vector<ResultTable>& tables, const ChartOptions& options, const char* says) {
    EXPECT_THAT([&] { drawn(tables, options); }, ThrowsMessage<InputError>(HasSubstr(says)));
  };
  const ResultTable azimuth = table_of("a.csv", cut), band = table_of("b.csv", {.ghz = steps_of(8, 12, 0.1)});
  refused({azimuth}, {.kind = ChartKind::map}, "a.csv holds no grid over two quantities; use --kind curves");
  refused({azimuth, azimuth}, {.kind = ChartKind::map}, "2 results; a map shows one");
  refused({band}, {.kind = ChartKind::polar}, "b.csv is a sweep over frequency (GHz), not over an angle");
  refused({azimuth, band}, {}, "a.csv is a sweep over azimuth φ (degrees), b.csv one over frequency (GHz); plot them one by one");
  refused({azimuth}, {.channels = {2}}, "--channels hv: a.csv has no such channel");
  refused(std::vector<ResultTable>(9, azimuth), {}, "9 results: more than 8");
  const ResultTable other = table_of("c.csv", {.theta = {30, 40}, .phi = cut.phi});
  refused({azimuth, other}, {}, "no cut of a.csv (10 GHz, θ = 90° ...) is in all other results");
}

TEST(LookTable, HoldsLevelAndPhase) {
  ResultTable table = table_of("a.csv", {});
  table.has_phase[0] = true;
  table.rows[0].s[0] = {0.0, 1.0};
  const std::string text = look_table(table, {}, {});
  EXPECT_THAT(text, AllOf(StartsWith("10 GHz, θ = 90°, φ = 0°\n"), HasSubstr("  VV              10.00         90.00\n"),
                          HasSubstr("  HH              -3.00             -\n"), Not(HasSubstr("HV"))));
}

}  // namespace
}  // namespace raytube
